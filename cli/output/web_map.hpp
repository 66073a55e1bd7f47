// Draws maps on a web page: what sheets of paper show, in figures that are as wide as the page or the phone. The ground
// is a picture, cells keep their edges, and lines, marks and letters are drawn by the browser at the size of its text.
//
//   WebMaps maps(store, grid.bounds(), progress);
//   html += maps.figure(content, "radius 10 km");
#pragma once

#include <map>
#include <string>

#include <itin/geometry.hpp>
#include <itin/store.hpp>
#include <viewshed/map_base.hpp>
#include <viewshed/result_sheet.hpp>

namespace itin::cli {

/// The rules that the figures need in the page's style sheet.
extern const char* const kWebMapStyle;

/// The maps of one page, over one frame. Parts that several of them show are in the page once.
class WebMaps {
 public:
  WebMaps(const Store& store, const Box& frame, Progress& progress);

  /// Returns the map with its scale bar, title, `about` (a phrase), statement and legend, as HTML. Throws FileError
  /// where a picture cannot be made.
  std::string figure(const viewshed::ResultSheet& content, const std::string& about);

 private:
  std::string part(std::string svg);

  Box frame_;
  viewshed::MapBase base_;
  std::map<std::string, std::size_t> parts_;  ///< the parts that are in the page, and their numbers
};

}  // namespace itin::cli
