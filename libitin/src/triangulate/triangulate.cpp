#include <algorithm>
#include <atomic>
#include <cmath>

#include <itin/parallel.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "triangulate/region.hpp"
#include "triangulate/standing_index.hpp"

namespace itin {

namespace {

/// Large windows are cut into quadtree cells of about this many points: enough to make borders cheap, few enough to
/// keep a cell's triangulation in the processor's cache.
constexpr double kTilePoints = 32768;

/// Cells that cover the window.
class TilePlan {
 public:
  TilePlan(const PointIndex& index, const Selection& selection, const GridWindow& window)
      : index_(index), selection_(selection), window_(window) {
    selected_leaves(index_, selection_, window_.bounds(), leaves_);
    std::erase_if(leaves_, [&](const Leaf& leaf) { return leaf.level < selection_.finest_in(leaf.cell.box()); });
    std::vector<std::uint32_t> all(leaves_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    split(Cell{}, all);
  }

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  void split(const Cell& cell, const std::vector<std::uint32_t>& leaves) {
    const GridBox square = square_of(cell);
    if (!window_.meets(square)) return;
    double points = 0;
    std::vector<std::uint32_t> inside;
    for (const std::uint32_t i : leaves) {
      const Cell& leaf = leaves_[i].cell;
      if (!cell.contains(leaf) && !leaf.contains(cell)) continue;
      inside.push_back(i);
      points += leaves_[i].points * std::min(1.0, std::ldexp(1.0, 2 * (cell.log2_side - leaf.log2_side)));
    }
    if (points <= kTilePoints || cell.log2_side == 0) {
      cells_.push_back(cell);
      return;
    }
    for (int i = 0; i < 4; ++i) split(cell.child(i), inside);
  }

  const PointIndex& index_;
  const Selection& selection_;
  const GridWindow& window_;
  std::vector<Leaf> leaves_;
  std::vector<Cell> cells_;
};

/// Puts the regions of a plan's cells together. Regions agree where they overlap, so what several hold is taken once.
class Assembly {
 public:
  Assembly(std::vector<RegionMesh> regions, const Grid& grid) : regions_(std::move(regions)) { tin_.grid = grid; }

  Tin run() && {
    number_vertices();
    gather_triangles();
    gather_lines();
    for (const RegionMesh& region : regions_) tin_.statistics += region.statistics;
    return std::move(tin_);
  }

 private:
  static std::uint64_t code(const SelectedVertex& v) { return morton(v.point.x, v.point.y); }

  /// Merges the regions' vertex lists, each in Morton order already, and notes each one's new number.
  void number_vertices() {
    std::vector<std::vector<std::uint64_t>> codes(regions_.size());
    parallel_for(regions_.size(), [&](std::size_t r) {
      codes[r].resize(regions_[r].vertices.size());
      std::transform(regions_[r].vertices.begin(), regions_[r].vertices.end(), codes[r].begin(), code);
    });
    std::vector<std::uint64_t> all;
    for (const auto& c : codes) all.insert(all.end(), c.begin(), c.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    tin_.vertices.resize(all.size());
    tin_.sources.resize(all.size());
    const bool any = std::any_of(regions_.begin(), regions_.end(), [](const RegionMesh& region) {
      return std::any_of(region.vertices.begin(), region.vertices.end(), [](const auto& v) { return v.theme != 0; });
    });
    if (any) tin_.standing.resize(all.size());
    numbers_.resize(regions_.size());
    parallel_for(regions_.size(), [&](std::size_t r) {
      numbers_[r].resize(codes[r].size());
      auto at = all.begin();
      for (std::size_t v = 0; v < codes[r].size(); ++v) {
        at = std::lower_bound(at, all.end(), codes[r][v]);
        numbers_[r][v] = static_cast<std::uint32_t>(at - all.begin());
      }
    });
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      for (std::size_t v = 0; v < numbers_[r].size(); ++v) {
        tin_.vertices[numbers_[r][v]] = regions_[r].vertices[v].point;
        tin_.sources[numbers_[r][v]] = regions_[r].vertices[v].source;
        if (any) tin_.standing[numbers_[r][v]] = regions_[r].vertices[v].theme;
      }
    }
  }

  void gather_triangles() {
    std::vector<std::vector<Triangle>> parts(regions_.size());
    parallel_for(regions_.size(), [&](std::size_t r) {
      for (const auto& [a, b, c] : regions_[r].mesh.triangles) {
        Triangle t{numbers_[r][a], numbers_[r][b], numbers_[r][c]};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        parts[r].push_back(t);
      }
      std::sort(parts[r].begin(), parts[r].end());
    });
    for (const auto& part : parts) {
      const auto middle = static_cast<std::ptrdiff_t>(tin_.triangles.size());
      tin_.triangles.insert(tin_.triangles.end(), part.begin(), part.end());
      // Cells come in Morton order, so parts overlap only near their borders.
      const auto low = part.empty()
                           ? tin_.triangles.end()
                           : std::lower_bound(tin_.triangles.begin(), tin_.triangles.begin() + middle, part.front());
      std::inplace_merge(low, tin_.triangles.begin() + middle, tin_.triangles.end());
    }
    tin_.triangles.erase(std::unique(tin_.triangles.begin(), tin_.triangles.end()), tin_.triangles.end());
  }

  void gather_lines() {
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      for (const LineEdge& e : regions_[r].lines)
        tin_.lines.push_back({numbers_[r][e.from], numbers_[r][e.to], e.theme});
    }
    std::sort(tin_.lines.begin(), tin_.lines.end());
    tin_.lines.erase(std::unique(tin_.lines.begin(), tin_.lines.end()), tin_.lines.end());
  }

  std::vector<RegionMesh> regions_;
  std::vector<std::vector<std::uint32_t>> numbers_;  ///< per region and vertex: its number in the result
  Tin tin_;
};

/// Lines of a part are its theme's. What keeps the ground about standing features is none.
void name_themes(Tin& tin, const StoreMetadata& metadata) {
  if (metadata.parts.empty()) return;
  std::erase_if(tin.lines, [&](const LineEdge& e) {
    return e.theme <= metadata.themes.size() && metadata.themes[e.theme - std::size_t{1}].stands();
  });
  for (LineEdge& e : tin.lines) {
    if (e.theme > metadata.themes.size()) e.theme = metadata.parts[e.theme - metadata.themes.size() - 1].theme;
  }
  std::sort(tin.lines.begin(), tin.lines.end());
  tin.lines.erase(std::unique(tin.lines.begin(), tin.lines.end()), tin.lines.end());
}

}  // namespace

Tin triangulate(const Store& store, const Window& window, const Detail& detail, Progress& progress,
                const ThemeChoice& themes) {
  const StoreMetadata& metadata = store.metadata();
  const Selection selection = selection_of(metadata, detail, themes);
  const GridWindow grid_window(window, metadata.grid, metadata.bounds);
  const StandingIndex index(store, selection);
  const TilePlan plan(index, selection, grid_window);

  std::vector<RegionMesh> regions(plan.cells().size());
  std::atomic<std::size_t> done = 0;
  parallel_for(regions.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    const Cell& cell = plan.cells()[i];
    regions[i] = triangulate_region(index, selection, square_of(cell), window.is_all() ? nullptr : &grid_window);
    progress.report("triangulating", static_cast<double>(++done) / static_cast<double>(regions.size()));
  });
  Tin tin = Assembly(std::move(regions), metadata.grid).run();
  name_themes(tin, metadata);
  return tin;
}

}  // namespace itin
