#include "horizon_fan.hpp"

#include <algorithm>

#include <itin/parallel.hpp>

#include "rounded_outwards.hpp"

namespace itin::viewshed {

namespace {

constexpr std::size_t kFirstRing = 16;  ///< slabs
/// So many sectors a slab: they are a bin wide at the end of their ring, and each lies in one of the ring before.
constexpr std::size_t kSectorsASlab = 2 * Quadrant::kRun;
constexpr std::size_t kSectorsATask = 64;

}  // namespace

HorizonFan::HorizonFan(const Quadrant& quadrant, const Sector::Axis& axis, std::size_t slabs) {
  for (std::size_t slab = kFirstRing; slab < slabs; slab *= 2) {
    const std::size_t count = kSectorsASlab * slab;
    Ring ring{slab, std::vector<float>(count)};
    parallel_for((count + kSectorsATask - 1) / kSectorsATask, [&](std::size_t task) {
      for (std::size_t i = task * kSectorsATask; i < std::min(count, (task + 1) * kSectorsATask); ++i) {
        const double width = 2 / static_cast<double>(count), from = static_cast<double>(i) * width - 1;
        const Sector::Hidden nearer =
            rings_.empty() ? Sector::Hidden{} : Sector::Hidden{rings_.back().slab, rings_.back().below[i / 2]};
        const Sector sector(quadrant, from, from + width, axis);
        ring.below[i] = rounded_down(sector.look_on(nearer, slab, [](const Sector::Hidden&) {}).below);
      }
    });
    rings_.push_back(std::move(ring));
  }
}

Sector::Hidden HorizonFan::known(double from, double to, std::size_t nearest) const {
  const auto ring = std::find_if(rings_.rbegin(), rings_.rend(), [&](const Ring& r) { return r.slab <= nearest; });
  if (ring == rings_.rend()) return {};
  // Rounding may make it one sector less: by far less than sectors look at beside them.
  const auto sector_at = [&](double slope) {
    const double at = (slope + 1) * static_cast<double>(ring->below.size()) / 2;
    return ring->below.begin() +
           static_cast<std::ptrdiff_t>(std::clamp(at, 0.0, static_cast<double>(ring->below.size() - 1)));
  };
  return {ring->slab, *std::min_element(sector_at(from), sector_at(to) + 1)};
}

}  // namespace itin::viewshed
