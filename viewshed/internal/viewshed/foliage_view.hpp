// Viewsheds through woods.
//
//   const viewshed::ThroughFoliage seen =
//       viewshed::compute_through_foliage(store, request, {.leaf_area = 0.1}, options, progress);
//   use(seen.computed.result.visible, seen.foliage.length_m, seen.foliage.transmittance);
#pragma once

#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <profile/foliage.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// What a viewshed through foliage tells besides verdicts, by cell. Where several observers look at a cell, it is that
/// of the one whose light comes through best.
struct FoliageView {
  /// Metres of foliage on the line; NaN outside, and where something solid hides.
  std::vector<float> length_m;
  /// The share of the light that comes through; 0 where something solid hides, NaN outside.
  std::vector<float> transmittance;
};

struct ThroughFoliage {
  ViewshedWithSurface computed;  ///< its surface has the woods
  FoliageView foliage;
};

/// Computes a viewshed of mode kVisible in which woods are not solid: of what nothing else hides, a cell is visible
/// where enough light comes through, as profile::through_foliage() has it for the line to its centre.
///
/// Two viewsheds bound the answer: what woods do not hide has no foliage before it, and what anything else hides is
/// hidden. Lines are walked only to cells between the two, and only over triangles of vegetation (foliage_about.hpp),
/// about 15 nanoseconds each. Where ends stand on the surface, the woods are no part of it, and lines are walked to all
/// cells that nothing else hides. The result does not depend on the memory. Throws what profile::through_foliage() and
/// compute_with_surface() throw, and InputError for other modes.
ThroughFoliage compute_through_foliage(const Store& store, const Request& request, const profile::Foliage& foliage,
                                       const ComputeOptions& options, Progress& progress);

}  // namespace itin::viewshed
