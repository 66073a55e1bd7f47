#include <algorithm>
#include <cmath>

#include <itin/degrees.hpp>
#include <profile/multipath_fading.hpp>

namespace itin::profile {

namespace {

double power_of_db(double db) {
  return std::pow(10, db / 10);
}

/// The exponent q_a of shallow fades as a function of q_t, section 2.3.2 step 3.
double shallow_exponent(double fade_db, double qt) {
  const double field = std::pow(10, -fade_db / 20);
  return 2 + (1 + 0.3 * field) * std::pow(10, -0.016 * fade_db) * (qt + 4.3 * (field + fade_db / 800));
}

/// The q_t with which the distribution of shallow fades meets that of deep ones at this fade and percentage.
double shape_through(double fade_db, double percent) {
  const double exponent = -20 * std::log10(-std::log1p(-percent / 100)) / fade_db;
  const double field = std::pow(10, -fade_db / 20);
  return (exponent - 2) / ((1 + 0.3 * field) * std::pow(10, -0.016 * fade_db)) - 4.3 * (field + fade_db / 800);
}

}  // namespace

double geoclimatic_factor(double refractivity_gradient) {
  return std::pow(10, -4.6 - 0.0027 * refractivity_gradient);
}

double multipath_occurrence(const MultipathPath& path, double geoclimatic_factor) {
  return geoclimatic_factor * std::pow(path.length_km, 3.1) * std::pow(1 + path.inclination_mrad, -1.29) *
         std::pow(path.frequency_ghz, 0.8) * std::pow(10, -0.00089 * path.lower_m);
}

double multipath_exceeded(double occurrence_percent, double fade_db, double part) {
  const double deep_db = 25 + 1.2 * std::log10(occurrence_percent);
  if (fade_db >= deep_db) return part * occurrence_percent / power_of_db(fade_db);
  const double there = part * occurrence_percent / power_of_db(deep_db);
  const double exponent = shallow_exponent(fade_db, shape_through(deep_db, there));
  return -100 * std::expm1(-std::pow(10, -exponent * fade_db / 20));
}

double year_of_month(const MultipathPath& path, double latitude_deg) {
  constexpr double kMost = 10.8;
  const double turn = std::pow(std::abs(std::cos(2 * in_radians(latitude_deg))), 0.7);
  const double of_latitude = std::abs(latitude_deg) <= 45 ? 1.1 + turn : 1.1 - turn;
  const double db = 10.5 - 5.6 * std::log10(of_latitude) - 2.7 * std::log10(path.length_km) +
                    1.7 * std::log10(1 + path.inclination_mrad);
  return 1 / power_of_db(std::min(db, kMost));
}

}  // namespace itin::profile
