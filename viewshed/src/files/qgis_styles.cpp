#include <viewshed/qgis_styles.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

std::string qgis_style(const Request& request) {
  switch (request.mode) {
    case Mode::kCount:
      return banded_style(count_bands(request.observers.size()));
    case Mode::kProbability:
      return banded_style(limit_bands({0.05, 0.25, 0.5, 0.75, 0.95}, "of the surfaces"));
    case Mode::kLoss:
      return banded_style(limit_bands({3, 6, 10, 20, 30, 40, 60}, "dB"));
    case Mode::kVisible:
    case Mode::kFresnel:
    case Mode::kWhich:
    case Mode::kAngle:
    case Mode::kNearest:
    case Mode::kBlocker:
    case Mode::kHeight:
      return "";
  }
  return "";
}

std::string qgis_style_of_shares() {
  return banded_style(share_bands());
}

}  // namespace itin::viewshed
