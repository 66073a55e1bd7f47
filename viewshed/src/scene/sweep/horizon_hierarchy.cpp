#include "scene/sweep/horizon_hierarchy.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <itin/parallel.hpp>

#include "line/rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kFirst = 16;  ///< slabs up to where sectors are twice as many for the first time
/// Sectors per slab of distance: they are a bin wide where they become twice as many.
constexpr std::size_t kSectorsPerSlab = 2 * Quadrant::kRun;
constexpr std::size_t kRings = 8;  ///< how many rings are kept up to there
static_assert(kFirst % kRings == 0);
constexpr std::size_t kSectorsPerTask = 64;

}  // namespace

void HorizonHierarchy::advance(const Quadrant& quadrant, const Sector::Axis& axis, std::size_t slab,
                               const Progress& progress) {
  slab = std::min(slab, farthest_);
  while (front_.slab < slab) {
    if (front_.slab == widest_) widen();
    const std::size_t step = widest_ / kRings, ring = (front_.slab / step + 1) * step, end = std::min(slab, ring);
    const auto [first, last] = sectors();
    const double width = 2 / static_cast<double>(front_.below.size());
    // Slopes that are not computed may hide anything.
    std::fill_n(front_.above.begin(), first, kFloatInfinity);
    std::fill_n(front_.above.rbegin(), front_.above.size() - last, kFloatInfinity);
    parallel_for((last - first + kSectorsPerTask - 1) / kSectorsPerTask, [&, first = first,
                                                                          last = last](std::size_t task) {
      progress.throw_if_cancelled();
      const std::size_t begin = first + task * kSectorsPerTask;
      for (std::size_t i = begin; i < std::min(last, begin + kSectorsPerTask); ++i) {
        const double from = static_cast<double>(i) * width - 1;
        const Sector sector(quadrant, from, from + width, axis);
        const auto [hidden, above] = sector.continue_horizon({{front_.slab, front_.below[i]}, front_.above[i]}, end);
        front_.below[i] = rounded_down(hidden.below), front_.above[i] = rounded_up(above);
      }
    });
    front_.slab = end;
    if (end == ring) rings_.push_back(front_);
  }
}

/// Makes twice as many sectors, or the first ones.
void HorizonHierarchy::widen() {
  widest_ = widest_ == 0 ? kFirst : 2 * widest_;
  for (std::vector<float>* const of : {&front_.below, &front_.above}) {
    const std::vector<float> wide = std::move(*of);
    of->assign(kSectorsPerSlab * widest_, -kFloatInfinity);
    for (std::size_t i = 0; i < 2 * wide.size(); ++i) (*of)[i] = wide[i / 2];
  }
}

/// The first and the end of the front's sectors that lines may lie in, with a few more against rounding.
std::pair<std::size_t, std::size_t> HorizonHierarchy::sectors() const {
  const auto count = static_cast<double>(front_.below.size());
  const auto at = [&](double slope, double more) {
    return static_cast<std::size_t>(std::clamp((slope + 1) * count / 2 + more, 0.0, count));
  };
  const std::size_t first = at(slopes_.first, -2);
  return {first, std::max(first, at(slopes_.second, 3))};
}

Sector::Horizon HorizonHierarchy::Ring::known(double from, double to) const {
  // Rounding may give a neighbouring sector, but errs by far less than sectors look at beside them.
  const auto sector_at = [&](double slope) {
    const double at = (slope + 1) * static_cast<double>(below.size()) / 2;
    return static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, static_cast<double>(below.size() - 1)));
  };
  const std::ptrdiff_t first = sector_at(from), end = sector_at(to) + 1;
  return {{slab, *std::min_element(below.begin() + first, below.begin() + end)},
          *std::max_element(above.begin() + first, above.begin() + end)};
}

Sector::Horizon HorizonHierarchy::known(double from, double to, std::size_t nearest) const {
  if (front_.slab > 0 && front_.slab <= nearest) return front_.known(from, to);
  const auto farther = std::upper_bound(rings_.begin(), rings_.end(), nearest,
                                        [](std::size_t slab, const Ring& r) { return slab < r.slab; });
  return farther == rings_.begin() ? Sector::Horizon{} : std::prev(farther)->known(from, to);
}

}  // namespace itin::viewshed
