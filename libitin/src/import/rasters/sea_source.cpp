#include "import/rasters/sea_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "geometry/post_lattice.hpp"
#include "geometry/whole_division.hpp"
#include "import/rasters/raster_source.hpp"
#include "import/source/source_context.hpp"
#include "pyramid/pyramid.hpp"
#include "triangulate/region/grid_window.hpp"

namespace itin {

namespace {

constexpr double kSeaGapSteps = 1.9;  // a missing post leaves a hole; posts beside it need not lie on the lattice
constexpr double kMostSeaPosts = 4e9;
constexpr std::size_t kSeaBatch = 1 << 16;

/// Orders lattices of squares by their sides, the widest first.
struct WidestFirst {
  bool operator()(const PostLattice& a, const PostLattice& b) const {
    return std::tuple(-a.side(), a.x, a.y) < std::tuple(-b.side(), b.x, b.y);
  }
};

/// Places of a lattice, in squares of 64 by 64. Only squares with places are kept.
class SeaPlaces {
 public:
  void add(std::int64_t column, std::int64_t row) {
    const std::uint64_t at = key(column, row);
    if (last_ == nullptr || at != last_key_) last_ = &squares_[at], last_key_ = at;
    (*last_)[row & 63] |= bit(column);
  }
  bool has(std::int64_t column, std::int64_t row) const {
    const auto square = squares_.find(key(column, row));
    return square != squares_.end() && (square->second[row & 63] & bit(column)) != 0;
  }

 private:
  static std::uint64_t key(std::int64_t column, std::int64_t row) {
    return static_cast<std::uint64_t>(column >> 6) << 32 ^ static_cast<std::uint32_t>(row >> 6);
  }
  static std::uint64_t bit(std::int64_t column) { return std::uint64_t{1} << (column & 63); }

  using Square = std::array<std::uint64_t, 64>;
  std::unordered_map<std::uint64_t, Square> squares_;
  Square* last_ = nullptr;  ///< the square that a post was added to; posts come side by side
  std::uint64_t last_key_ = 0;
};

/// The step of an upright square lattice in whole grid units; nothing if the source is not on one.
std::optional<std::int64_t> upright_step(const SourceInfo& info, double resolution) {
  const auto& [ux, uy, vx, vy] = info.gap_basis;
  const double step = std::abs(ux) / kGapSteps / resolution;
  if (uy != 0 || vx != 0 || std::abs(ux) != std::abs(vy) || step < 1 || std::abs(step - std::round(step)) > 1e-6)
    return std::nullopt;
  return std::llround(step);
}

}  // namespace

/// The posts seen, by the lattice that they lie on, and the area to be filled.
class SeaFill::Lattices {
 public:
  Lattices(double level, std::optional<Window> area, const Box& box, const Grid& grid)
      : level_(level), area_(std::move(area)), box_(area_ ? area_->bounds() : box), grid_(grid) {}

  void add(const SourceInfo& info, std::span<const GridPoint> points) {
    coarsest_ = std::max(coarsest_, info.spacing);
    const auto step = upright_step(info, grid_.resolution);
    if (!step || points.empty()) return;
    const PostLattice lattice = PostLattice{points.front().x, points.front().y, *step, *step}.from_first_place();
    SeaPlaces& places = seen_[lattice];
    for (const GridPoint& p : points) {
      const std::int64_t east = p.x - lattice.x, north = p.y - lattice.y;
      if (east % *step == 0 && north % *step == 0) places.add(east / *step, north / *step);
    }
  }

  double level() const { return level_; }
  double resolution() const { return grid_.resolution; }
  PostLattice lattice() const {
    const std::int64_t own = std::max<std::int64_t>(1, std::llround(coarsest_ / grid_.resolution));
    return seen_.empty() || seen_.begin()->first.side() < own ? PostLattice{0, 0, own, own} : seen_.begin()->first;
  }

  /// Calls visit(share of rows done, points) row by row from the north, each row from the west.
  template <class Visit>
  void for_each_row(const Visit& visit) const {
    const PostLattice lattice = this->lattice();
    const auto seen = seen_.find(lattice);
    const GridBox box = grid_.enclosing(box_);
    const auto first = [&](std::int64_t v, std::int64_t phase) { return ceil_divide(v - phase, lattice.side()); };
    const auto last = [&](std::int64_t v, std::int64_t phase) { return floor_divide(v - phase, lattice.side()); };
    const std::int64_t west = first(box.xmin, lattice.x), east = last(box.xmax, lattice.x),
                       south = first(box.ymin, lattice.y), north = last(box.ymax, lattice.y);
    require_few(static_cast<double>(east - west + 1) * static_cast<double>(north - south + 1));
    std::optional<GridWindow> window;
    if (area_) window.emplace(*area_, grid_, box);
    const auto z = static_cast<std::int32_t>(std::lround(level_ / grid_.resolution));
    std::vector<GridPoint> points;
    for (std::int64_t row = north; row >= south; --row) {
      points.clear();
      for (std::int64_t column = west; column <= east; ++column) {
        if (seen != seen_.end() && seen->second.has(column, row)) continue;
        const auto x = static_cast<std::int32_t>(lattice.x + column * lattice.step_x),
                   y = static_cast<std::int32_t>(lattice.y + row * lattice.step_y);
        if (!window || window->contains(x, y)) points.push_back({x, y, z});
      }
      visit(static_cast<double>(north - row) / static_cast<double>(north - south + 1), points);
    }
  }

 private:
  static void require_few(double posts) {
    if (posts > kMostSeaPosts)
      throw InputError(
          fmt::format(
              "`sea_level`: the sea would have {:.1e} posts, which is beyond any store; give a smaller `sea_area`",
              posts),
          "sea_level");
  }

  double level_;
  std::optional<Window> area_;
  Box box_;
  Grid grid_;
  double coarsest_ = 0;
  std::map<PostLattice, SeaPlaces, WidestFirst> seen_;
};

namespace {

class WatchedSource final : public TerrainSource {
 public:
  using Watch = std::function<void(const SourceInfo&, std::span<const GridPoint>)>;
  WatchedSource(std::unique_ptr<TerrainSource> source, Watch watch)
      : source_(std::move(source)), watch_(std::move(watch)) {}

  ReadCounts read(const Sink& sink, Progress& progress) override {
    const SourceInfo info = source_->info();
    watch_(info, {});
    return source_->read(
        [&](std::span<const GridPoint> points) {
          watch_(info, points);
          sink(points);
        },
        progress);
  }
  SourceInfo info() const override { return source_->info(); }
  double size_hint() const override { return source_->size_hint(); }

 private:
  std::unique_ptr<TerrainSource> source_;
  Watch watch_;
};

template <class Lattices>
class SeaTerrain final : public TerrainSource {
 public:
  explicit SeaTerrain(std::shared_ptr<Lattices> lattices) : lattices_(std::move(lattices)) {}

  ReadCounts read(const Sink& sink, Progress& progress) override {
    ReadCounts counts;
    std::vector<GridPoint> batch;
    lattices_->for_each_row([&](double done, const std::vector<GridPoint>& points) {
      progress.throw_if_cancelled();
      progress.report("filling the sea", done);
      batch.insert(batch.end(), points.begin(), points.end());
      if (batch.size() >= kSeaBatch) sink(std::exchange(batch, {}));
      for (const GridPoint& p : points) counts.bounds.extend(p.x, p.y);
    });
    if (!batch.empty()) sink(batch);
    return counts;
  }

  SourceInfo info() const override {
    const double step = static_cast<double>(lattices_->lattice().side()) * lattices_->resolution();
    SourceInfo info;
    info.path = sea_name(lattices_->level());
    info.kind = kSea;
    info.imported = utc_now();
    info.spacing = step;
    info.gap_basis = {kSeaGapSteps * step, 0, 0, kSeaGapSteps * step};
    return info;
  }
  double size_hint() const override { return 0; }

 private:
  std::shared_ptr<Lattices> lattices_;
};

}  // namespace

SeaFill::SeaFill(double level, const std::optional<Window>& area, const Box& box, const Grid& grid)
    : lattices_(std::make_shared<Lattices>(level, area, box, grid)) {}
SeaFill::~SeaFill() = default;

std::unique_ptr<TerrainSource> SeaFill::watch(std::unique_ptr<TerrainSource> source) {
  return std::make_unique<WatchedSource>(
      std::move(source), [lattices = lattices_](const SourceInfo& info, std::span<const GridPoint> points) {
        lattices->add(info, points);
      });
}

std::unique_ptr<TerrainSource> SeaFill::source() && {
  return std::make_unique<SeaTerrain<Lattices>>(std::move(lattices_));
}

std::string sea_name(double level) {
  return fmt::format("sea at {:g} m", level + 0.0);
}

}  // namespace itin
