#include "triangulate/assembly.hpp"

#include <algorithm>
#include <utility>

#include <itin/parallel.hpp>

namespace itin {

namespace {

Triangle smallest_first(const Triangle& t) {
  if (t[1] < t[0] && t[1] < t[2]) return {t[1], t[2], t[0]};
  if (t[2] < t[0] && t[2] < t[1]) return {t[2], t[0], t[1]};
  return t;
}

/// A region's vertices in its own cell come one after another, and so do the cells: what lies there is in order
/// already, vertices as well as the triangles of which they are the first. All else is foreign to the region; mostly,
/// but not always, it is some other's own as well.
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
    parallel_for(parts_.size(), [&](std::size_t r) { sort_triangles(regions_[r].mesh.triangles, parts_[r]); });
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
    std::vector<Triangle> own, foreign;  ///< each in order
    bool owns(std::size_t v) const { return v >= first && v < end; }
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

  /// The codes of all vertices.
  void list_codes() {
    std::vector<std::uint64_t> foreign, nobodys;
    for (const Part& part : parts_) {
      const auto at = [&](std::size_t v) { return part.codes.begin() + static_cast<std::ptrdiff_t>(v); };
      codes_.insert(codes_.end(), at(part.first), at(part.end));
      foreign.insert(foreign.end(), part.codes.begin(), at(part.first));
      foreign.insert(foreign.end(), at(part.end), part.codes.end());
    }
    std::sort(foreign.begin(), foreign.end());
    foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
    std::set_difference(foreign.begin(), foreign.end(), codes_.begin(), codes_.end(), std::back_inserter(nobodys));
    const auto middle = static_cast<std::ptrdiff_t>(codes_.size());
    codes_.insert(codes_.end(), nobodys.begin(), nobodys.end());
    std::inplace_merge(codes_.begin(), codes_.begin() + middle, codes_.end());
  }

  void place_vertices() {
    const bool any = std::any_of(regions_.begin(), regions_.end(), [](const RegionMesh& region) {
      return std::any_of(region.vertices.begin(), region.vertices.end(), [](const auto& v) { return v.theme != 0; });
    });
    tin_.vertices.resize(codes_.size());
    tin_.sources.resize(codes_.size());
    if (any) tin_.standing.resize(codes_.size());
    const auto place = [&](std::size_t r, std::size_t v) {
      const SelectedVertex& vertex = regions_[r].vertices[v];
      const std::uint32_t number = parts_[r].numbers[v];
      tin_.vertices[number] = vertex.point;
      tin_.sources[number] = vertex.source;
      if (any) tin_.standing[number] = vertex.theme;
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

  /// With the new numbers, which are in the order of the old ones.
  static void sort_triangles(const std::vector<Triangle>& triangles, Part& part) {
    std::vector<std::uint32_t> first_of(part.end - part.first + 2, 0);
    for (const Triangle& t : triangles) {
      if (const std::uint32_t v = std::min({t[0], t[1], t[2]}); part.owns(v)) ++first_of[v - part.first + 2];
    }
    for (std::size_t i = 2; i < first_of.size(); ++i) first_of[i] += first_of[i - 1];
    part.own.resize(first_of.back());
    for (const Triangle& t : triangles) {
      const auto& [a, b, c] = smallest_first(t);
      const Triangle renumbered{part.numbers[a], part.numbers[b], part.numbers[c]};
      if (part.owns(a)) {
        part.own[first_of[a - part.first + 1]++] = renumbered;
      } else {
        part.foreign.push_back(renumbered);
      }
    }
    const auto second = [](const Triangle& t) { return t[1]; };
    for (std::size_t i = 0; i + 1 < first_of.size(); ++i)
      std::ranges::sort(part.own.begin() + first_of[i], part.own.begin() + first_of[i + 1], {}, second);
    std::sort(part.foreign.begin(), part.foreign.end());
  }

  void gather_triangles() {
    std::vector<Triangle> own, foreign;
    std::size_t count = 0;
    for (const Part& part : parts_) count += part.own.size();
    own.reserve(count);
    for (Part& part : parts_) {
      own.insert(own.end(), part.own.begin(), part.own.end());
      foreign.insert(foreign.end(), part.foreign.begin(), part.foreign.end());
      part.own = {};
    }
    std::sort(foreign.begin(), foreign.end());
    foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
    std::vector<Triangle> nobodys;
    std::set_difference(foreign.begin(), foreign.end(), own.begin(), own.end(), std::back_inserter(nobodys));
    const auto middle = static_cast<std::ptrdiff_t>(own.size());
    own.insert(own.end(), nobodys.begin(), nobodys.end());
    std::inplace_merge(own.begin(), own.begin() + middle, own.end());
    tin_.triangles = std::move(own);
  }

  void gather_lines() {
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      const std::vector<std::uint32_t>& numbers = parts_[r].numbers;
      for (const LineEdge& e : regions_[r].lines) tin_.lines.push_back({numbers[e.from], numbers[e.to], e.theme});
    }
    std::sort(tin_.lines.begin(), tin_.lines.end());
    tin_.lines.erase(std::unique(tin_.lines.begin(), tin_.lines.end()), tin_.lines.end());
  }

  std::vector<RegionMesh> regions_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> codes_;  ///< of the result's vertices, ascending
  Tin tin_;
};

}  // namespace

Tin assemble(std::vector<RegionMesh> regions, std::span<const Cell> cells, const Grid& grid) {
  return Assembly(std::move(regions), cells, grid).run();
}

}  // namespace itin
