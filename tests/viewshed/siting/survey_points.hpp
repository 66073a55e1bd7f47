// A survey's cells asked about as points.
#pragma once

#include <viewshed/site_coverage.hpp>

namespace itin::test {

using viewshed::DemandSet, viewshed::SiteSurvey;

/// The survey with a point at each cell's centre, the padding's included, where element numbers stay.
inline SiteSurvey survey_of_points(const SiteSurvey& survey) {
  SiteSurvey of_points = survey;
  of_points.targets.grid.reset();
  const RasterGrid& grid = *survey.targets.grid;
  for (std::size_t element = 0; element < viewshed::element_count(grid); ++element) {
    const RasterGrid::Cell cell = viewshed::cell_of(grid, element);
    of_points.targets.points.push_back(grid.centre(cell.column, cell.row));
  }
  return of_points;
}

/// Without the padding about the grid, whose cells are not asked but whose points are.
inline DemandSet without_padding(const RasterGrid& grid, const DemandSet& set) {
  DemandSet result;
  for (const DemandSet::Block& block : set.blocks()) {
    std::uint64_t members = 0;
    for (unsigned bit = 0; bit < 64; ++bit) {
      const RasterGrid::Cell cell = viewshed::cell_of(grid, std::size_t{64} * block.number + bit);
      if (cell.column < grid.columns() && cell.row < grid.rows()) members |= block.members & std::uint64_t{1} << bit;
    }
    result.add(block.number, members);
  }
  return result;
}

}  // namespace itin::test
