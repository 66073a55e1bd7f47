#include <array>
#include <cmath>

#include <itin/precondition.hpp>
#include <itin/wood_loss.hpp>

namespace itin {

namespace {

struct WoodAt {
  double mhz, db_per_m, greatest_db;
};

constexpr std::array<WoodAt, 5> kWoods{
    {{105.9, 0.04, 9.4}, {466.475, 0.12, 18}, {949, 0.17, 26.5}, {1852.2, 0.30, 29}, {2117.5, 0.34, 34.1}}};

double between(double a, double b, double share) {
  return a * std::pow(b / a, share);
}

}  // namespace

std::optional<double> wood_loss_db(double frequency_mhz, double metres) {
  ITIN_PRECONDITION(metres >= 0);
  for (std::size_t i = 0; i + 1 < kWoods.size(); ++i) {
    const WoodAt &a = kWoods[i], &b = kWoods[i + 1];
    if (frequency_mhz < a.mhz || frequency_mhz > b.mhz) continue;
    const double share = std::log(frequency_mhz / a.mhz) / std::log(b.mhz / a.mhz);
    const double greatest = between(a.greatest_db, b.greatest_db, share);
    return greatest * (1 - std::exp(-metres * between(a.db_per_m, b.db_per_m, share) / greatest));
  }
  return std::nullopt;
}

}  // namespace itin
