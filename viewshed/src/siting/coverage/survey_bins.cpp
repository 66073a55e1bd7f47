#include "siting/coverage/survey_bins.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <itin/triangulate.hpp>
#include <viewshed/surface.hpp>

#include "bounds/surface_heights.hpp"
#include "plan/memory.hpp"
#include "plan/partition.hpp"
#include "run/segments.hpp"
#include "siting/coverage/site_window.hpp"
#include "siting/coverage/target_ground.hpp"

namespace itin::viewshed {

namespace {

constexpr double kNarrowest = 0.5;  ///< metres

class SurfaceBinner {
 public:
  /// Divides the memory: a quarter is for bins, a quarter for bins that are divided, and the rest for triangles read at
  /// once.
  SurfaceBinner(const Store& store, const SiteSurvey& survey, std::uint64_t bytes, Statistics& statistics)
      : store_(store),
        survey_(survey),
        most_points_(bytes / 2 / (kPointsWithFeatures * kBytesPerSurfacePoint)),
        statistics_(statistics),
        binned_{bins_within(bytes / 4), std::vector<double>(survey.targets.grid ? survey.targets.grid->cell_count()
                                                                                : survey.targets.points.size(),
                                                            kNoSurface)},
        tiles_(binned_.bins.tiles()) {}

  SurveyBins run(Progress& progress) && {
    const auto fits = [&](const CellRectangle& piece) {
      return piece.count() == 1 || store_.points_about(0, box_of(piece)) <= most_points_;
    };
    auto pieces = parts_that_fit(all_cells(tiles_), fits, [](const CellRectangle& piece) { return halves(piece); });
    std::erase_if(pieces, [&](const CellRectangle& piece) { return !is_in_reach(box_of(piece)); });
    const auto effort = [&](const CellRectangle& piece) {
      return Effort{effort_of_triangles(store_.points_about(0, box_of(piece))), 0};
    };
    for_each_segment(pieces, effort, progress,
                     [&](const CellRectangle& piece, SegmentProgress& of_piece) { add(piece, of_piece); });
    return std::move(binned_);
  }

 private:
  SurfaceBins bins_within(std::uint64_t bytes) const {
    const Box box = intersection(reach_of(survey_), extent_of(store_));
    const std::uint64_t most = std::max<std::uint64_t>(1, bytes / SurfaceBins::kBytesPerBin);
    const double side = std::max(kNarrowest, std::sqrt(box.width() * box.height() / static_cast<double>(most)));
    return {store_.metadata().grid, box, side, bytes / SurfaceBins::kBytesPerDivided};
  }

  Box box_of(const CellRectangle& piece) const {
    return tiles_.part({piece.column, piece.row}, piece.columns, piece.rows).bounds();
  }
  bool is_in_reach(const Box& box) const {
    return std::any_of(survey_.positions.begin(), survey_.positions.end(), [&](const SitePosition& place) {
      return squared_distance(place.position, box) <= survey_.radius * survey_.radius;
    });
  }

  void add(const CellRectangle& piece, SegmentProgress& progress) {
    // Reads a little more than the piece, so that nothing at its edge is missing.
    const Box box = box_of(piece);
    const Window window = Window::box({box.xmin - 1, box.ymin - 1, box.xmax + 1, box.ymax + 1});
    const Tin surface = read(window, survey_.themes, progress.reading(0.5));
    binned_.bins.add(surface, piece);
    add_ground(survey_.targets.on_surface ? surface : read(window, ThemeChoice::none(), progress.reading()));
  }
  Tin read(const Window& window, const ThemeChoice& themes, Progress& progress) {
    Tin tin = triangulate(store_, window, Detail::tolerance(0), progress, themes);
    statistics_.retrieval += tin.statistics;
    statistics_.triangles += tin.triangles.size();
    return tin;
  }

  void add_ground(const Tin& tin) {
    std::vector<double>& ground = binned_.ground;
    if (const std::optional<RasterGrid>& grid = survey_.targets.grid) {
      for_each_tile_on(tin, *grid, [&](const Tile& tile, const TileValues<double>& heights) {
        for_each_cell(tile, [&](std::size_t cell, RasterGrid::Cell place) {
          if (!std::isnan(heights[cell])) ground[grid->index(place)] = heights[cell];
        });
      });
    } else {
      for_each_point_on(tin, survey_.targets.points, [&](std::size_t point, double height) { ground[point] = height; });
    }
  }

  const Store& store_;
  const SiteSurvey& survey_;
  std::uint64_t most_points_;  ///< the most points that are read at once
  Statistics& statistics_;
  SurveyBins binned_;
  RasterGrid tiles_;  ///< its cells are tiles of bins
};

}  // namespace

SurveyBins bin_surface(const Store& store, const SiteSurvey& survey, std::uint64_t bytes, Statistics& statistics,
                       Progress& progress) {
  const std::uint64_t ground =
      sizeof(double) * (survey.targets.grid ? survey.targets.grid->cell_count() : survey.targets.points.size());
  return SurfaceBinner(store, survey, bytes - std::min(bytes / 2, ground), statistics).run(progress);
}

}  // namespace itin::viewshed
