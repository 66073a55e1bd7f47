// How maps on paper are wanted: on which paper, at which scale, and what their title blocks say besides the map.
//
//   profile::SheetChoice sheets;
//   sheets.papers = {profile::PaperSize::kA3, profile::PaperSize::kA1};
//   sheets.project = "Mynydd y Gwair", sheets.date = "1 July 2027";
#pragma once

#include <string>
#include <vector>

namespace itin::profile {

/// The sizes of paper in landscape, as in ISO 216.
enum class PaperSize { kA4, kA3, kA1 };
/// Returns a name like "A3".
const char* name_of(PaperSize paper);

struct SheetChoice {
  std::vector<PaperSize> papers = {};  ///< the papers of every map; empty: no sheets
  double scale = 0;                    ///< 100000 for 1:100,000; 0: the largest usual one that shows all
  std::string project = {};            ///< for title blocks, as the date is
  std::string date = {};
  std::string basemap = {};  ///< a georeferenced picture in place of the shaded relief; empty: none

  /// Returns the project and the date alone, for a map that is made unasked.
  SheetChoice names() const { return {.project = project, .date = date}; }
};

}  // namespace itin::profile
