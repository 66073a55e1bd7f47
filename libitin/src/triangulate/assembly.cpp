#include "triangulate/assembly.hpp"

#include <algorithm>
#include <utility>

#include <itin/parallel.hpp>
#include <itin/sort_unique.hpp>

namespace itin {

namespace {

/// Assembles the regions. A region's vertices in its own cell come one after another, and so do the cells. Such
/// vertices, and the triangles of which they are the first, are therefore in order already. All others are foreign to
/// the region; most of them, but not all, are some other region's own.
class Assembly {
 public:
  Assembly(std::vector<RegionMesh> regions, std::span<const Cell> cells, const Grid& grid)
      : regions_(std::move(regions)), parts_(regions_.size()) {
    tin_.grid = grid;
    parallel_for(parts_.size(), [&](std::size_t r) { find_own(cells[r], regions_[r].vertices, parts_[r]); });
  }

  Tin run() && {
    list_codes();
    place_vertices();
    gather_triangles();
    gather_lines();
    for (const RegionMesh& region : regions_) tin_.statistics += region.statistics;
    return std::move(tin_);
  }

 private:
  struct Part {
    std::vector<std::uint64_t> codes;    ///< by vertex
    std::size_t first = 0, end = 0;      ///< the region's own vertices
    std::vector<std::uint32_t> numbers;  ///< by vertex: its number in the result
    bool owns(std::size_t v) const { return v >= first && v < end; }
  };

  /// A run of a region's triangles, and the place in the result where they go.
  struct Slice {
    std::vector<Triangle>::const_iterator first, end;
    std::size_t place;
  };

  static void find_own(const Cell& cell, const std::vector<SelectedVertex>& vertices, Part& part) {
    part.codes.resize(vertices.size());
    std::transform(vertices.begin(), vertices.end(), part.codes.begin(),
                   [](const SelectedVertex& v) { return code_of(v); });
    const auto at = [&](std::uint64_t code) {
      return static_cast<std::size_t>(std::lower_bound(part.codes.begin(), part.codes.end(), code) -
                                      part.codes.begin());
    };
    part.first = at(cell.code), part.end = at(cell.end());
  }

  /// Adds the foreign items that are no region's own. `own` is in ascending order, and stays so.
  template <class Item>
  static void add_those_of_nobody(std::vector<Item> foreign, std::vector<Item>& own) {
    sort_unique(foreign);
    std::vector<Item> nobodys;
    std::set_difference(foreign.begin(), foreign.end(), own.begin(), own.end(), std::back_inserter(nobodys));
    const auto middle = static_cast<std::ptrdiff_t>(own.size());
    own.insert(own.end(), nobodys.begin(), nobodys.end());
    std::inplace_merge(own.begin(), own.begin() + middle, own.end());
  }

  static Triangle renumbered(const Triangle& t, const std::vector<std::uint32_t>& numbers) {
    return {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  }

  /// Lists the codes of all vertices.
  void list_codes() {
    std::vector<std::uint64_t> foreign;
    for (const Part& part : parts_) {
      const auto at = [&](std::size_t v) { return part.codes.begin() + static_cast<std::ptrdiff_t>(v); };
      codes_.insert(codes_.end(), at(part.first), at(part.end));
      foreign.insert(foreign.end(), part.codes.begin(), at(part.first));
      foreign.insert(foreign.end(), at(part.end), part.codes.end());
    }
    add_those_of_nobody(std::move(foreign), codes_);
  }

  void place_vertices() {
    const bool any = std::any_of(regions_.begin(), regions_.end(), [](const RegionMesh& region) {
      return std::any_of(region.vertices.begin(), region.vertices.end(), [](const auto& v) { return v.theme != 0; });
    });
    tin_.vertices.resize(codes_.size());
    tin_.sources.resize(codes_.size());
    if (any) tin_.raised_theme.resize(codes_.size());
    const auto place = [&](std::size_t r, std::size_t v) {
      const SelectedVertex& vertex = regions_[r].vertices[v];
      const std::uint32_t number = parts_[r].numbers[v];
      tin_.vertices[number] = vertex.point;
      tin_.sources[number] = vertex.source;
      if (any) tin_.raised_theme[number] = vertex.theme;
    };
    parallel_for(parts_.size(), [&](std::size_t r) {
      number_vertices(parts_[r]);
      for (std::size_t v = parts_[r].first; v < parts_[r].end; ++v) place(r, v);
    });
    for (std::size_t r = 0; r < parts_.size(); ++r) {
      for (std::size_t v = 0; v < parts_[r].codes.size(); ++v) {
        if (!parts_[r].owns(v)) place(r, v);
      }
    }
  }

  void number_vertices(Part& part) const {
    part.numbers.resize(part.codes.size());
    auto at = codes_.begin();
    for (std::size_t v = 0; v < part.codes.size(); ++v) {
      // Own vertices mostly follow each other.
      if (at == codes_.end() || *at != part.codes[v]) at = std::lower_bound(at, codes_.end(), part.codes[v]);
      part.numbers[v] = static_cast<std::uint32_t>(at++ - codes_.begin());
    }
  }

  /// Gathers the triangles. A region's own triangles stand together, too.
  void gather_triangles() {
    std::vector<Slice> own;
    std::vector<Triangle> foreign;
    std::size_t count = 0;
    for (std::size_t r = 0; r < parts_.size(); ++r) {
      const std::vector<Triangle>& triangles = regions_[r].mesh.triangles;
      const auto at = [&](std::size_t vertex) {
        return std::partition_point(triangles.begin(), triangles.end(),
                                    [&](const Triangle& t) { return t[0] < vertex; });
      };
      const auto first = at(parts_[r].first), end = at(parts_[r].end);
      own.push_back({first, end, count});
      count += static_cast<std::size_t>(end - first);
      const auto renumber = [&](const Triangle& t) { return renumbered(t, parts_[r].numbers); };
      std::transform(triangles.begin(), first, std::back_inserter(foreign), renumber);
      std::transform(end, triangles.end(), std::back_inserter(foreign), renumber);
    }
    tin_.triangles.resize(count);
    parallel_for(parts_.size(), [&](std::size_t r) {
      std::transform(own[r].first, own[r].end, tin_.triangles.begin() + static_cast<std::ptrdiff_t>(own[r].place),
                     [&](const Triangle& t) { return renumbered(t, parts_[r].numbers); });
    });
    add_those_of_nobody(std::move(foreign), tin_.triangles);
  }

  void gather_lines() {
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      const std::vector<std::uint32_t>& numbers = parts_[r].numbers;
      for (const LineEdge& e : regions_[r].lines) tin_.lines.push_back({numbers[e.from], numbers[e.to], e.theme});
    }
    sort_unique(tin_.lines);
  }

  std::vector<RegionMesh> regions_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> codes_;  ///< Morton codes of the result's vertices, ascending
  Tin tin_;
};

}  // namespace

Tin assemble(std::vector<RegionMesh> regions, std::span<const Cell> cells, const Grid& grid) {
  return Assembly(std::move(regions), cells, grid).run();
}

}  // namespace itin
