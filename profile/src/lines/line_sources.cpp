#include "lines/line_sources.hpp"

#include <set>

#include <itin/progress.hpp>
#include <itin/same_place.hpp>
#include <itin/triangulate.hpp>

namespace itin::profile {

std::vector<SourceInfo> sources_under(const Store& store, const StoreLine& line) {
  const Grid& grid = store.metadata().grid;
  const double width = 4 * grid.resolution;
  const Window window = same_place(grid, line.from, line.to) ? Window::disc(line.from, width)
                                                             : Window::corridor(line.from, line.to, width);
  NoProgress progress;
  const Tin tin = triangulate(store, window, line.detail, progress, line.themes);
  std::vector<SourceInfo> sources;
  for (const std::uint16_t number : std::set<std::uint16_t>(tin.sources.begin(), tin.sources.end()))
    sources.push_back(store.metadata().sources[number]);
  return sources;
}

}  // namespace itin::profile
