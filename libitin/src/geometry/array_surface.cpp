// A surface made of an array of heights.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster.hpp>
#include <itin/tin.hpp>

#include "geometry/cell.hpp"

namespace itin {

namespace {

constexpr double kMostUnits = 2147483647;
constexpr std::size_t kMostPosts = 2147483647;

void require_usable(const RasterGrid& posts, std::span<const float> heights, double resolution) {
  if (heights.size() != posts.cell_count())
    throw InputError(
        fmt::format("`heights`: {} are given for {} x {} posts", heights.size(), posts.rows(), posts.columns()),
        "heights");
  if (posts.columns() < 2 || posts.rows() < 2)
    throw InputError(fmt::format("`heights`: {} x {} posts span no surface", posts.rows(), posts.columns()), "heights");
  if (posts.cell_count() > kMostPosts)
    throw InputError(fmt::format("`heights`: {} are more than {}", posts.cell_count(), kMostPosts), "heights");
  if (!(resolution > 0) || !std::isfinite(resolution))
    throw InputError(fmt::format("`resolution`: {} must be positive", resolution), "resolution");
  const double width = static_cast<double>(posts.columns()) * posts.cell_width(),
               height = static_cast<double>(posts.rows()) * posts.cell_height();
  if (std::max(width, height) / resolution > kMostUnits)
    throw InputError(fmt::format("`resolution`: {} is too fine for a raster of {} x {} m", resolution, width, height),
                     "resolution");
  if (std::min(posts.cell_width(), posts.cell_height()) < resolution)
    throw InputError(fmt::format("`resolution`: {} is too coarse for cells of {} x {} m", resolution,
                                 posts.cell_width(), posts.cell_height()),
                     "resolution");
}

/// Triangles name their corners by the numbers of posts until the vertices are in their order.
class ArraySurface {
 public:
  ArraySurface(const RasterGrid& posts, std::span<const float> heights, double resolution)
      : posts_(posts), heights_(heights) {
    tin_.grid = {posts.centre(0, 0), resolution};
  }

  Tin tin() && {
    for (std::int64_t row = 0; row + 1 < posts_.rows(); ++row)
      for (std::int64_t column = 0; column + 1 < posts_.columns(); ++column) add_cell(column, row);
    if (tin_.triangles.empty()) throw InputError("`heights`: no three neighbours have heights", "heights");
    number_vertices();
    return std::move(tin_);
  }

 private:
  std::uint32_t post(std::int64_t column, std::int64_t row) const {
    return static_cast<std::uint32_t>(posts_.index({column, row}));
  }
  bool there(std::uint32_t post) const { return std::isfinite(heights_[post]); }

  /// Adds the two triangles between four posts, or the one between three.
  void add_cell(std::int64_t column, std::int64_t row) {
    const std::uint32_t nw = post(column, row), ne = post(column + 1, row), sw = post(column, row + 1),
                        se = post(column + 1, row + 1);
    // The diagonal runs from the north-west, as in every square of a store.
    const bool falling = there(nw) && there(se);
    for (const Triangle& t : falling ? std::array{Triangle{sw, se, nw}, Triangle{se, ne, nw}}
                                     : std::array{Triangle{sw, se, ne}, Triangle{sw, ne, nw}})
      if (there(t[0]) && there(t[1]) && there(t[2])) tin_.triangles.push_back(t);
  }

  GridPoint place(std::uint32_t post) const {
    const auto columns = static_cast<std::uint32_t>(posts_.columns());
    const double z = std::round(static_cast<double>(heights_[post]) / tin_.grid.resolution);
    if (std::abs(z) > kMostUnits)
      throw InputError(
          fmt::format("`heights`: {} m is beyond the numbers of a grid of {} m", heights_[post], tin_.grid.resolution),
          "heights");
    const Point2 centre = posts_.centre(post % columns, post / columns);
    return tin_.grid.quantise({centre.x, centre.y, static_cast<double>(heights_[post])});
  }

  /// Makes vertices of the posts that triangles have, in their order, and puts the triangles in theirs.
  void number_vertices() {
    std::vector<std::uint32_t> number(posts_.cell_count(), 0);
    for (const Triangle& t : tin_.triangles)
      for (const std::uint32_t corner : t) number[corner] = 1;
    std::vector<std::pair<VertexId, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < number.size(); ++i) {
      if (number[i] == 0) continue;
      const GridPoint p = place(i);
      order.emplace_back(morton(p.x, p.y), i);
    }
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      number[order[i].second] = i;
      tin_.vertices.push_back(place(order[i].second));
    }
    tin_.sources.assign(order.size(), 0);
    for (Triangle& t : tin_.triangles) {
      for (std::uint32_t& corner : t) corner = number[corner];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    std::sort(tin_.triangles.begin(), tin_.triangles.end());
  }

  const RasterGrid& posts_;
  std::span<const float> heights_;
  Tin tin_;
};

}  // namespace

Tin surface_through(const RasterGrid& posts, std::span<const float> heights, double resolution) {
  require_usable(posts, heights, resolution);
  return ArraySurface(posts, heights, resolution).tin();
}

}  // namespace itin
