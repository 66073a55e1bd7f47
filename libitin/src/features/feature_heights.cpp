#include "features/feature_heights.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/triangulate.hpp>

#include "features/terrain_heights.hpp"
#include "store/point_index.hpp"
#include "store/store_format.hpp"

namespace itin {

namespace {

/// Metres.
constexpr double kSquare = 256;
/// Grid steps by which heights of both surfaces may be rounded.
constexpr double kRounding = 2;

using Square = std::pair<std::int64_t, std::int64_t>;

/// Those in which a theme has vertices.
std::set<Square> squares_of(const Store& store, std::size_t theme) {
  const StoreMetadata& metadata = store.metadata();
  std::vector<Leaf> leaves;
  store.points().leaves(store.points().level_count(), metadata.bounds, leaves);
  std::set<Square> squares;
  for (const Leaf& leaf : leaves) {
    if (leaf.theme <= metadata.themes.size() || leaf.points == 0) continue;
    if (metadata.parts[leaf.theme - metadata.themes.size() - 1].theme != theme) continue;
    const auto block = store.points().block(leaf);
    for (const GridPoint& p : block->points) {
      const Point2 at = metadata.grid.position(p.x, p.y);
      squares.emplace(static_cast<std::int64_t>(std::floor(at.x / kSquare)),
                      static_cast<std::int64_t>(std::floor(at.y / kSquare)));
    }
  }
  return squares;
}

class Comparing {
 public:
  Comparing(const Store& store, const ThemeInfo& theme)
      : store_(store), theme_(theme), choice_(ThemeChoice::parse(theme.name)) {}

  /// A store may be too broken for a surface.
  std::optional<Damage> in(const Square& square) const {
    try {
      return compared(square);
    } catch (const Error& error) {
      return Damage{fmt::format("theme '{}'", theme_.name), fmt::format("has no surface: {}", error.what())};
    }
  }

 private:
  std::optional<Damage> compared(const Square& square) const {
    const auto [column, row] = square;
    const Box box{static_cast<double>(column) * kSquare, static_cast<double>(row) * kSquare,
                  static_cast<double>(column + 1) * kSquare, static_cast<double>(row + 1) * kSquare};
    NoProgress quiet;
    const Tin bare = triangulate(store_, Window::box(box), Detail::tolerance(0), quiet, ThemeChoice::none());
    const Tin themed = triangulate(store_, Window::box(box), Detail::tolerance(0), quiet, choice_);
    const TerrainHeights low(bare), high(themed);
    for (const Tin* tin : {&bare, &themed}) {
      for (const GridPoint& p : tin->vertices) {
        if (auto found = at(p, low, high, box)) return found;
      }
    }
    return std::nullopt;
  }

  std::optional<Damage> at(const GridPoint& p, const TerrainHeights& low, const TerrainHeights& high,
                           const Box& box) const {
    const Grid& grid = store_.metadata().grid;
    const Point2 place = grid.position(p.x, p.y);
    if (!box.contains(place)) return std::nullopt;
    const auto ground = low.height_at({p.x, p.y}), top = high.height_at({p.x, p.y});
    if (!ground || !top || *top - *ground <= kRounding * grid.resolution) return std::nullopt;
    const double said = store_.greatest_feature_height(choice_, {place.x, place.y, place.x, place.y});
    if (*top - *ground <= said + kRounding * grid.resolution) return std::nullopt;
    return Damage{fmt::format("theme '{}'", theme_.name),
                  fmt::format("rises {:.2f} m above the ground at {:.2f},{:.2f}, where the index says at most {:.2f} m",
                              *top - *ground, place.x, place.y, said)};
  }

  const Store& store_;
  const ThemeInfo& theme_;
  ThemeChoice choice_;
};

}  // namespace

std::vector<Damage> features_above_their_heights(const Store& store, Progress& progress) {
  std::vector<Damage> damage;
  const std::vector<ThemeInfo>& themes = store.metadata().themes;
  for (std::size_t t = 1; t <= themes.size(); ++t) {
    if (!themes[t - 1].stands()) continue;
    const std::set<Square> squares = squares_of(store, t);
    const std::vector<Square> all(squares.begin(), squares.end());
    const Comparing comparing(store, themes[t - 1]);
    std::vector<std::optional<Damage>> found(all.size());
    std::atomic<std::size_t> done = 0;
    parallel_for(all.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      found[i] = comparing.in(all[i]);
      progress.report("checking features", static_cast<double>(++done) / static_cast<double>(all.size()));
    });
    for (auto& one : found)
      if (one) damage.push_back(std::move(*one));
  }
  return damage;
}

}  // namespace itin
