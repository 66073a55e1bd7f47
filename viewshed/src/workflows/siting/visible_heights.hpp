// How much of every candidate turbine the demand sees. Visible heights of turbines add, so that each turbine is an
// element of its own, whose weight is the turbine's sum. The choice of the least total height is then the one that
// serves the least.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

/// Turbines at some options.
struct ShownTurbines {
  const SitePlanRequest& request;
  const SiteInputs& inputs;
  std::vector<std::size_t> options;
  NoData nodata = NoData::kBlock;  ///< kBlock: what is certainly seen; kClear: what may be
};

/// Returns for each turbine the metres from its tip down that are seen, times the weight of the place that sees them,
/// summed over the demand within the radius. Throws as survey_turbines() does.
std::vector<double> summed_visible_heights(const Store& store, const ShownTurbines& turbines, Progress& progress);

class OwnElements final : public Coverage {
 public:
  explicit OwnElements(std::size_t options);
  const CoverageBounds& bounds(std::size_t option) const override { return bounds_[option]; }
  void refine(std::span<const std::size_t>) override {}

 private:
  std::vector<CoverageBounds> bounds_;
};

}  // namespace itin::viewshed
