// What the facades of dwellings see of turbines through woods, in leaf and in winter.
//
//   const SightsInSeason seasons(store, survey);
//   seasons.look(scene.surface().tin, turbines, facade, progress);   // facade.summer, facade.winter
#pragma once

#include <cstddef>
#include <span>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/tin.hpp>
#include <viewshed/dwellings.hpp>

#include "foliage/foliage_lines.hpp"

namespace itin::viewshed {

class SightsInSeason {
 public:
  /// The survey's request has foliage. Both must outlive this object. Throws InputError, CorruptStore.
  SightsInSeason(const Store& store, const DwellingsSurvey& survey);

  /// Looks at some turbines. Before, the facade's `winter` has what is seen past everything but woods, and `screened`
  /// what is seen with woods that are solid: what is hidden there stays hidden, what is seen here is seen, and lines
  /// are walked between the two. The least height seen of a turbine is found to a centimetre. `surface` has the woods
  /// under all lines. Throws CorruptStore, Cancelled.
  void look(const Tin& surface, std::span<const std::size_t> turbines, DwellingFacade& facade,
            Progress& progress) const;

 private:
  class Look;

  const DwellingsSurvey& survey_;
  FoliageLines lines_;
};

}  // namespace itin::viewshed
