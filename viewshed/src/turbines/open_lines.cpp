#include "turbines/open_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <itin/grazing.hpp>
#include <itin/grid_units.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/surface.hpp>

#include "bounds/cell_blocks.hpp"
#include "line/cell_tiles.hpp"
#include "line/infinity.hpp"
#include "progress/stage.hpp"
#include "turbines/zone_request.hpp"
#include "window/envelope.hpp"

namespace itin::viewshed {

namespace {

/// The coarse surfaces have at most this share of the full surface's points. Fine levels of rasters have half or more.
constexpr double kEnclosingShare = 2.0 / 3;
/// The number of points of the bare ground beneath one roof.
constexpr double kPointsPerTile = 8;

Envelope enclosing(const Store& store, const ThemeChoice& themes, const Window& window, Progress& progress) {
  const Box box = intersection(window.bounds(), extent_of(store));
  EnvelopeRequest wanted;
  wanted.window = window;
  const double most_points = kEnclosingShare * static_cast<double>(store.points_about(0, box));
  wanted.level = finest_level_of(store, box, static_cast<std::uint64_t>(most_points), 1);
  wanted.cut_by = wanted.enclosed = themes;
  return envelop(store, wanted, progress);
}

}  // namespace

bool may_tell_open_lines(const Store& store, const ZoneRequest& request) {
  return store.metadata().levels.size() > 1 && level_within(store.metadata(), request.detail.coarsest()) == 0;
}

/// Marks the open lines from one tile, to one turbine after another.
class OpenLines::TileMarker {
 public:
  TileMarker(const OpenLines& lines, const ExactScene& ground, std::size_t tile, Visibility& open)
      : lines_(lines),
        place_(ground.begin(tile)),
        height_(lines.zone_.request.observer_height / lines.units_.resolution),
        open_(open) {}

  void run(TileSet& needed) {
    const auto& turbines = lines_.zone_.request.turbines;
    const Tile& tile = place_->tile;
    const Box centres = box_of_centres(lines_.zone_.grid, tile);
    for (turbine_ = 0; turbine_ < turbines.size(); ++turbine_) {
      const double radius = turbines[turbine_].radius;
      if (squared_distance(turbines[turbine_].position, centres) <= radius * radius) open(all_of(tile), needed);
    }
  }

 private:
  static constexpr std::size_t kTogether = 8, kSmallest = 1;

  /// Marks the cells of the block that are not hidden for certain, and box by box the ground that their lines need.
  void open(const CellBlock& block, TileSet& needed) {
    if (hidden(block)) return;
    if (block.side() > kTogether)
      return for_each_quarter(block, [&](const CellBlock& quarter) { open(quarter, needed); });
    LineBundle bundle;
    bundle.end = base().z;
    mark(block, bundle);
    if (bundle.from_z < kInfinity) lines_.pyramid_->search(bundle, [&](std::uint32_t roof) { needed.add(roof / 2); });
  }

  /// Marks the cells of the block that are not hidden for certain, and adds their lines to the bundle.
  void mark(const CellBlock& block, LineBundle& bundle) {
    if (block.side() > kSmallest) {
      for_each_quarter(block, [&](const CellBlock& quarter) {
        if (!hidden(quarter)) mark(quarter, bundle);
      });
      return;
    }
    const Zone& zone = lines_.zone_;
    const Turbine& turbine = zone.request.turbines[turbine_];
    const RasterBit bit = turbine_bit(turbine.number);
    for_each_eye(block, [&](std::size_t cell, const Point3& eye) {
      const RasterGrid::Cell at{place_->tile.column + static_cast<std::int64_t>(cell % Tile::kSide),
                                place_->tile.row + static_cast<std::int64_t>(cell / Tile::kSide)};
      if (!in_reach(turbine, zone.grid, at)) return;
      open_.turbines[bit.grid * zone.grid.cell_count() + zone.grid.index(at)] |= bit.mask;
      bundle.add(line_from(eye));
    });
  }

  bool hidden(const CellBlock& block) const {
    const double highest = highest_eye(block);
    return highest == -kInfinity ||
           lines_.views_[turbine_].hides(box_about(block, place_->centres, *lines_.bounds_), highest);
  }

  SightLine line_from(const Point3& eye) const {
    const double resolution = lines_.units_.resolution;
    return {eye, base(), lines_.zone_.request.earth.drop_coefficient() * resolution, kGrazing / resolution};
  }
  Point3 base() const {
    const Point2 p = place_in_units(lines_.units_, lines_.zone_.request.turbines[turbine_].position);
    return {p.x, p.y, lines_.zone_.ground_m[turbine_] / lines_.units_.resolution};
  }

  /// Visits the eyes of the block's cells that have ground.
  template <class Visit>
  void for_each_eye(const CellBlock& block, const Visit& visit) const {
    for_each_cell(block, [&](std::size_t cell) {
      const Point2 p = place_->centres.at(cell);
      if (!std::isnan(place_->ground[cell])) visit(cell, Point3{p.x, p.y, place_->ground[cell] + height_});
    });
  }
  double highest_eye(const CellBlock& block) const {
    double highest = -kInfinity;
    for_each_eye(block, [&](std::size_t, const Point3& eye) { highest = std::max(highest, eye.z); });
    return highest;
  }

  const OpenLines& lines_;
  const std::unique_ptr<ExactScene::TileCells> place_;
  double height_;  ///< how high eyes are above the ground, grid units
  Visibility& open_;
  std::size_t turbine_ = 0;
};

OpenLines::OpenLines(const Store& store, const Zone& zone, const Window& window, Progress& progress)
    : zone_(zone), units_(store.metadata().grid) {
  bound(store, window, progress);
  view_turbines();
  roof_tiles();
}

void OpenLines::bound(const Store& store, const Window& window, Progress& progress) {
  const Envelope envelope = enclosing(store, *zone_.request.themes, window, progress);
  retrieval_ = envelope.lower.statistics;
  const Box box = envelope.lower.bounds();
  bounds_.emplace(envelope.lower, envelope.upper, envelope.outline, box,
                  std::max(side_of_bins(envelope.lower, box), zone_.grid.cell_width() / 2));
  tiles_.emplace(store, 0, box, kPointsPerTile);
}

void OpenLines::view_turbines() {
  const Earth& earth = zone_.request.earth;
  for (std::size_t k = 0; k < zone_.request.turbines.size(); ++k) {
    const Turbine& t = zone_.request.turbines[k];
    const Point2 place = place_in_units(units_, t.position);
    const double base = zone_.ground_m[k] / units_.resolution, reach = t.radius / units_.resolution + 1;
    HorizonView& view = views_.emplace_back(
        *bounds_, HorizonView::Axis{place.x, place.y, base, base + t.tip_height / units_.resolution, reach},
        earth.drop_coefficient() * units_.resolution, kGrazing / units_.resolution);
    view.advance(kInfinity);
  }
}

void OpenLines::roof_tiles() {
  // Margins beyond all rounding of places and heights.
  constexpr std::int32_t kBeside = 2, kAbove = 2;
  roofs_.grid = units_;
  for (std::size_t tile = 0; tile < tiles_->count(); ++tile) {
    const Box box = tiles_->box(tile);
    const float highest = bounds_->highest(bounds_->in_bins(box));
    const GridBox under = units_.enclosing(box);
    const std::int32_t z = std::isinf(highest) ? std::numeric_limits<std::int32_t>::min() / 2
                                               : static_cast<std::int32_t>(std::ceil(highest)) + kAbove;
    const auto first = static_cast<std::uint32_t>(roofs_.vertices.size());
    const std::int32_t west = under.xmin - kBeside, south = under.ymin - kBeside, east = under.xmax + kBeside,
                       north = under.ymax + kBeside;
    for (const auto& [x, y] : {std::pair(west, south), {east, south}, {east, north}, {west, north}})
      roofs_.vertices.push_back({x, y, z});
    roofs_.triangles.push_back({first, first + 1, first + 2});
    roofs_.triangles.push_back({first, first + 2, first + 3});
  }
  pyramid_.emplace(roofs_);
}

std::optional<Window> OpenLines::mark(const ExactScene& ground, std::span<const std::size_t> tiles, Visibility& open,
                                      Progress& progress) const {
  std::vector<TileSet> needed(tiles.size());
  for_each_step(tiles.size(), "open lines", progress, [&](std::size_t i) {
    needed[i] = TileSet(tiles_->count());
    std::make_unique<TileMarker>(*this, ground, tiles[i], open)->run(needed[i]);
  });
  TileSet all(tiles_->count());
  for (const TileSet& some : needed) all |= some;
  return all.empty() ? std::nullopt : std::optional(tiles_->window(all));
}

}  // namespace itin::viewshed
