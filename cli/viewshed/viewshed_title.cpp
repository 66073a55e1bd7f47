#include "viewshed/viewshed_title.hpp"

#include <fmt/format.h>

#include <itin/earth.hpp>

namespace itin::cli {

namespace {

std::string title_of_mode(const viewshed::Result& result) {
  using viewshed::Mode;
  const viewshed::Request& request = result.request;
  switch (request.mode) {
    case Mode::kCount:
    case Mode::kWhich:
      return "How many observers see each place";
    case Mode::kAngle:
      return "Elevation angle of what is seen";
    case Mode::kNearest:
      return "Nearest observer in sight";
    case Mode::kBlocker:
      return "What hides each place";
    case Mode::kHeight:
      return "Least height at which a target is seen";
    case Mode::kProbability:
      return "Probability of being visible";
    case Mode::kFresnel:
      return fmt::format("Fresnel zones at {:.6g} GHz", kSpeedOfLight / request.fresnel.wavelength);
    case Mode::kLoss:
      return fmt::format("Diffraction loss at {:.6g} GHz", request.radio.frequency_ghz);
    case Mode::kLevel:
      return fmt::format("Received level at {:.6g} GHz", request.radio.frequency_ghz);
    case Mode::kVisible:
      break;
  }
  return result.certified ? "Certified viewshed" : "Viewshed";
}

}  // namespace

std::string title_of(const viewshed::Result& result) {
  const double tolerance = answered_detail(result).coarsest();
  return title_of_mode(result) + (tolerance > 0 ? fmt::format(", at a tolerance of {:g} m", tolerance) : "");
}

Detail answered_detail(const viewshed::Result& result) {
  return result.certified ? Detail::tolerance(0) : result.request.detail;
}

}  // namespace itin::cli
