#include <filesystem>
#include <vector>

#include <viewshed/qgis_styles.hpp>

#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

/// A loss of 0 has a colour, too: only cells without a loss have none.
std::vector<ValueBand> loss_bands() {
  std::vector<ValueBand> bands = limit_bands({kLossLimitsDb.begin(), kLossLimitsDb.end()}, "dB");
  bands.front() = {0, "0 dB", {0, 114, 178}};
  return bands;
}

}  // namespace

std::string qgis_style(const Request& request) {
  switch (request.mode) {
    case Mode::kCount:
      return banded_style(count_bands(request.observers.size()));
    case Mode::kProbability:
      return banded_style(limit_bands({0.05, 0.25, 0.5, 0.75, 0.95}, "of the surfaces"));
    case Mode::kLoss:
      return banded_style(loss_bands());
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

std::string style_beside(const std::string& raster) {
  return std::filesystem::path(raster).replace_extension(".qml").string();
}

}  // namespace itin::viewshed
