// What maps of a zone of visibility show: every cell in a class, with the class's name and colour.
//
//   for (const ZoneMap& map : zone_maps(zone)) draw(map.title, map.classes, map.class_of_cell);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// The class of cells without a value.
inline constexpr std::uint8_t kNoMapClass = 255;

struct ZoneMap {
  struct Class {
    std::string label;
    Rgba colour;
    std::uint64_t cells = 0;
    std::uint64_t open_cells = 0;  ///< those where ground without data leaves some turbine undecided
    bool undecided = false;        ///< whether anything is seen from them is
  };
  std::string name;          ///< as in the names of files: "tip-count-screened"
  std::string title;         ///< "Zone of theoretical visibility: blade tips"
  std::string heading;       ///< heads its legend
  const char* seen = "tip";  ///< "tip", "hub", "proposal", "additional" or "farms"; "radar": what a radar sees
  bool screened = false;     ///< whether features hide what is behind them
  std::string season = {};   ///< "summer" or "winter" where woods are seen through
  std::vector<Class> classes;
  std::vector<std::uint8_t> class_of_cell;  ///< index of a class, or kNoMapClass
};

/// Returns maps of the tips seen, of the hubs seen where a hub is known, of the proposal's tips and of what it adds
/// where has_proposal(), and of combinations of farms where there are several; then all of these screened; then of tips
/// and hubs in each season where woods are seen through. The commonest combinations, `most_combinations` (up to 250) of
/// them, have classes of their own, and the others share one. The first class of each map holds the cells that
/// certainly see nothing; where the zone leaves_open(), the last holds the cells of which that is undecided, but for
/// seasons, of which nothing is undecided.
std::vector<ZoneMap> zone_maps(const Zone& zone, std::size_t most_combinations = 12);

/// Returns the map of the least heights that the radar sees in the study area; nothing without a radar. Its first class
/// is of ground that is seen, and the next to last, or the last where nothing is undecided, of ground above which
/// nothing is seen up to the greatest height that is told.
std::optional<ZoneMap> radar_map(const Zone& zone);

}  // namespace itin::viewshed
