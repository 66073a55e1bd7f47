// What an eye sees of the turbines of a zone, farm by farm.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <viewshed/turbine_sights.hpp>
#include <viewshed/turbine_view.hpp>
#include <viewshed/turbines.hpp>

namespace itin::cli {

using Sight = viewshed::TurbineSight;
using viewshed::Viewpoint;

/// Tells whether the tip is seen, or may be: whether a wireline shows the turbine.
inline bool is_shown(const Sight& sight) {
  return sight.tip != Sight::Verdict::kHidden;
}
/// Returns the smallest part of the horizon that holds the axes of the turbines shown; of all, where none is.
viewshed::Arc arc_to_shown(const std::vector<Sight>& sights);

/// What is seen of some turbines together.
struct Seen {
  std::size_t turbines = 0, tips = 0;
  std::size_t tips_beyond = 0;      ///< how many of the tips are beyond their turbine's radius, where maps count none
  std::size_t tips_undecided = 0;   ///< in addition to those seen
  std::optional<std::size_t> hubs;  ///< nothing: no hub's height is known
  std::optional<std::size_t> hubs_undecided;
  std::size_t hubs_known = 0;  ///< turbines whose hub height is known
  std::size_t nearest = 0;     ///< index in the request
  std::optional<std::size_t> nearest_seen;
  std::optional<viewshed::Arc> arc;  ///< the smallest that holds the rotors whose tips are seen
  double vertical_deg = 0;           ///< the greatest vertical angle that the visible part of a turbine takes up
  bool gaps = false;
};
/// Sums up the sights of some turbines. `turbines` are indices in the request, at least one.
Seen seen_of(const viewshed::Zone& zone, const std::vector<Sight>& sights, const std::vector<std::size_t>& turbines);
std::vector<std::size_t> all_turbines(const viewshed::Zone& zone);

/// Returns in a sentence what stands about the eye or close before it towards `to`; empty where nothing does. `surface`
/// has the features of the themes named, by their numbers from 1.
std::string before_the_eye(const SectionSurface& surface, const Viewpoint& from, Point2 to,
                           const std::vector<std::string>& themes);

}  // namespace itin::cli
