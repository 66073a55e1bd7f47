#include <cstdint>
#include <optional>

#include <itin/lattice_reader.hpp>
#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/relief.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/hillshade.hpp"

namespace itin::viewshed {

namespace {

constexpr std::uint64_t kMostReliefPoints = 1'500'000;

/// Heights from the posts of a lattice, where to read them costs less than to triangulate `points` points.
std::optional<std::vector<float>> heights_from_posts(const Store& store, const RasterGrid& pixels, std::uint64_t points,
                                                     Progress& progress) {
  constexpr std::uint64_t kPostsForAPoint = 8;
  const Box box = pixels.bounds();
  if (store.points_about(0, box) > kPostsForAPoint * points) return std::nullopt;
  const auto reader = LatticeReader::open(store, Window::box(box), ThemeChoice::none(), LatticeReader::Heights::kAll,
                                          kPostsForAPoint * kMostReliefPoints, progress);
  return reader ? std::optional(heights_at(reader->lattice(), pixels)) : std::nullopt;
}

}  // namespace

std::vector<float> ground_heights(const Store& store, const RasterGrid& pixels, double tolerance, Progress& progress) {
  const Box box = pixels.bounds();
  const int level = finest_level_of(store, box, kMostReliefPoints, level_within(store.metadata(), tolerance));
  if (auto heights = heights_from_posts(store, pixels, store.points_about(level, box), progress)) return *heights;
  return heights_at(triangulate(store, Window::box(box), detail_of(store.metadata(), level), progress), pixels);
}

Relief relief(const Store& store, const RasterGrid& pixels, Progress& progress) {
  constexpr double kTellable = 0.1;  ///< what is smaller cannot be told, in widths of a pixel
  return hillshade(pixels, ground_heights(store, pixels, kTellable * pixels.cell_width(), progress));
}

}  // namespace itin::viewshed
