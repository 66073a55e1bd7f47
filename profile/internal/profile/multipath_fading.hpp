// How often a radio wave that takes several ways through clear air cancels itself.
//
//   const MultipathPath path{.frequency_ghz = 7.5, .length_km = 34, .inclination_mrad = 2.9, .lower_m = 210};
//   const double p0 = multipath_occurrence(path, geoclimatic_factor(-300));
//   const double month = multipath_exceeded(p0, 38);                       // percent of the worst month
//   const double year = multipath_exceeded(p0, 38, year_of_month(path, 51.5));
//
// Source: ITU-R P.530-17 section 2.3, its method for quick planning, which needs no map. P.530-18 has another method,
// for which maps of two factors are needed. The equations of 2.3.1 and 2.3.4 were compared with implementations of
// P.2001 (attachment B.3), which repeats them; those of 2.3.2 with implementations of P.530-17 and P.530-18.
#pragma once

#include <optional>

namespace itin::profile {

/// The ranges of the method: GHz, of which the least is also 15 / km; and km, up to which paths do not fade so.
inline constexpr double kMultipathTo = 45, kMultipathLength = 15, kShortestToFade = 5;

struct MultipathPath {
  double frequency_ghz = 0;
  double length_km = 0;
  double inclination_mrad = 0;  ///< how steep the line between the antennas is, without a sign
  double lower_m = 0;           ///< the elevation of the lower antenna
};

/// The geoclimatic factor K by the gradient of refractivity, N-units per km, in the lowest 65 m that is not exceeded
/// for 1 % of an average year: 10^(-4.6 - 0.0027 dN1), section 2.3.1.
double geoclimatic_factor(double refractivity_gradient);

/// The percentage p0 of the average worst month by which the distribution of deep fades is scaled, section 2.3.1. It
/// may be above 100.
double multipath_occurrence(const MultipathPath& path, double geoclimatic_factor);

/// The percentage of a time that fades are deeper than `fade_db`, 0 or more, sections 2.3.1 and 2.3.2. `part` is 1 for
/// the average worst month and year_of_month() for the average year.
double multipath_exceeded(double occurrence_percent, double fade_db, double part = 1);

/// The percentage of the year over that of the worst month, for deep fades at this latitude, section 2.3.4.
double year_of_month(const MultipathPath& path, double latitude_deg);

}  // namespace itin::profile
