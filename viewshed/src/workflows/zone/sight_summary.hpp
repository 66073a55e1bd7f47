// What an eye sees of the turbines of a zone, farm by farm.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <viewshed/turbine_sights.hpp>
#include <viewshed/turbine_view.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Tells whether the tip is seen, or may be: whether a wireline shows the turbine.
inline bool is_shown(const TurbineSight& sight) {
  return sight.tip != TurbineSight::Verdict::kHidden;
}
/// Returns the smallest part of the horizon that holds the axes of the turbines shown; of all, where none is.
Arc arc_to_shown(const std::vector<TurbineSight>& sights);

/// Sums up the sights of some turbines. `turbines` are indices in `all`, at least one.
SightSummary seen_of(const std::vector<Turbine>& all, const std::vector<TurbineSight>& sights,
                     const std::vector<std::size_t>& turbines);
inline SightSummary seen_of(const Zone& zone, const std::vector<TurbineSight>& sights,
                            const std::vector<std::size_t>& turbines) {
  return seen_of(zone.request.turbines, sights, turbines);
}
std::vector<std::size_t> all_turbines(const Zone& zone);

/// Returns in a sentence what stands about the eye or close before it towards `to`; empty where nothing does. `surface`
/// has the features of the themes named, by their numbers from 1.
std::string before_the_eye(const SectionSurface& surface, const Viewpoint& from, Point2 to,
                           const std::vector<std::string>& themes);

}  // namespace itin::viewshed
