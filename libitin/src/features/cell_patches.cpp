#include "features/cell_patches.hpp"

#include <algorithm>
#include <array>

namespace itin {

namespace {

constexpr std::array<int, 4> kRight{1, 0, -1, 0}, kDown{0, 1, 0, -1};  ///< step in each direction; the next turns right

/// A corner of cells, counted from the first, and the direction in which an edge leaves it.
struct EdgeOfCell {
  int column = 0, row = 0, direction = 0;

  EdgeOfCell turned(int by) const { return {column, row, (direction + by) % 4}; }
  EdgeOfCell at_its_end() const {
    const auto d = static_cast<std::size_t>(direction);
    return {column + kRight[d], row + kDown[d], direction};
  }
};

class PatchCutter {
 public:
  PatchCutter(const HeightCells& cells, std::span<const std::int32_t> steps)
      : cells_(cells), steps_(steps), labels_(steps.size(), 0), seen_(4 * corners(), false) {}

  std::vector<CellPatch> run() {
    label();
    for (int row = 0; row <= cells_.rows; ++row)
      for (int column = 0; column <= cells_.columns; ++column)
        for (int direction = 0; direction < 4; ++direction) trace({column, row, direction});
    return std::move(patches_);
  }

 private:
  std::size_t corners() const {
    return (static_cast<std::size_t>(cells_.columns) + 1) * (static_cast<std::size_t>(cells_.rows) + 1);
  }
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_.columns) + static_cast<std::size_t>(column);
  }
  bool inside(int column, int row) const {
    return column >= 0 && row >= 0 && column < cells_.columns && row < cells_.rows;
  }

  /// Numbers the patches from 1.
  void label() {
    for (int row = 0; row < cells_.rows; ++row) {
      for (int column = 0; column < cells_.columns; ++column) {
        const std::size_t i = cell(column, row);
        if (steps_[i] == 0 || labels_[i] != 0) continue;
        patches_.push_back({{}, steps_[i]});
        flood(column, row);
      }
    }
  }

  void flood(int column, int row) {
    const auto number = static_cast<std::uint32_t>(patches_.size());
    std::vector<std::array<int, 2>> open{{column, row}};
    labels_[cell(column, row)] = number;
    while (!open.empty()) {
      const auto [c, r] = open.back();
      open.pop_back();
      for (std::size_t d = 0; d < 4; ++d) {
        const int nc = c + kRight[d], nr = r + kDown[d];
        if (!inside(nc, nr) || steps_[cell(nc, nr)] != patches_.back().steps || labels_[cell(nc, nr)] != 0) continue;
        labels_[cell(nc, nr)] = number;
        open.push_back({nc, nr});
      }
    }
  }

  std::uint32_t label_at(int column, int row) const { return inside(column, row) ? labels_[cell(column, row)] : 0; }
  std::uint32_t right_of(const EdgeOfCell& e) const {
    return label_at(e.column - (e.direction == 1 || e.direction == 2 ? 1 : 0), e.row - (e.direction >= 2 ? 1 : 0));
  }
  std::uint32_t left_of(const EdgeOfCell& e) const {
    return label_at(e.column - (e.direction >= 2 ? 1 : 0), e.row - (e.direction == 0 || e.direction == 3 ? 1 : 0));
  }
  /// The patch whose outline has the edge, to its right; 0 for none.
  std::uint32_t patch_of(const EdgeOfCell& e) const { return right_of(e) == left_of(e) ? 0 : right_of(e); }

  std::size_t number_of(const EdgeOfCell& e) const {
    return 4 * (static_cast<std::size_t>(e.row) * (static_cast<std::size_t>(cells_.columns) + 1) +
                static_cast<std::size_t>(e.column)) +
           static_cast<std::size_t>(e.direction);
  }

  /// Where two cells of a patch meet at a corner alone, the ring turns left and stays with the cell outside, so that it
  /// does not come to that corner again.
  EdgeOfCell after(const EdgeOfCell& e, std::uint32_t patch) const {
    const EdgeOfCell end = e.at_its_end();
    for (const int quarters : {3, 0}) {
      if (patch_of(end.turned(quarters)) == patch) return end.turned(quarters);
    }
    return end.turned(1);
  }

  void trace(const EdgeOfCell& first) {
    const std::uint32_t patch = patch_of(first);
    if (patch == 0 || seen_[number_of(first)]) return;
    PlanRing ring;
    EdgeOfCell e = first;
    do {
      seen_[number_of(e)] = true;
      const EdgeOfCell next = after(e, patch);
      if (next.direction != e.direction) ring.push_back(cells_.corner_at(next.column, next.row));
      e = next;
    } while (number_of(e) != number_of(first));
    patches_[patch - 1].rings.push_back(std::move(ring));
  }

  const HeightCells& cells_;
  std::span<const std::int32_t> steps_;
  std::vector<std::uint32_t> labels_;  ///< the patch of each cell, from 1
  std::vector<bool> seen_;             ///< edges, four for each corner
  std::vector<CellPatch> patches_;
};

}  // namespace

std::int32_t steps_of(std::int64_t above_ground, const HeightCells& rule) {
  if (above_ground <= 0 || above_ground < rule.threshold) return 0;
  const std::int64_t step = rule.step;
  const std::int64_t steps = rule.rounding == HeightRounding::nearest ? (2 * above_ground + step) / (2 * step)
                             : rule.rounding == HeightRounding::up    ? (above_ground + step - 1) / step
                                                                      : above_ground / step;
  return static_cast<std::int32_t>(steps);
}

std::vector<CellPatch> patches_of(const HeightCells& cells, std::span<const std::int32_t> steps) {
  return PatchCutter(cells, steps).run();
}

}  // namespace itin
