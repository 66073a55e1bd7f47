// What maps of a zone of visibility show: every cell in a class, with the class's name and colour.
//
//   for (const ZoneMap& map : zone_maps(zone)) draw(map.title, map.classes, map.class_of_cell);
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Cells without a value have it.
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
  const char* seen = "tip";  ///< "tip", "hub" or "farms"
  bool screened = false;
  std::vector<Class> classes;
  std::vector<std::uint8_t> class_of_cell;  ///< index of a class, or kNoMapClass
};

/// Tips seen, hubs where one is known, and combinations of farms where there are several; then all of them screened.
/// The commonest combinations have classes of their own, `most_combinations` (up to 250) of them, the others one
/// together. The first class of each map is of cells that certainly see nothing, and where the zone leaves_open() the
/// last one of those of which that is undecided.
std::vector<ZoneMap> zone_maps(const Zone& zone, std::size_t most_combinations = 12);

}  // namespace itin::viewshed
