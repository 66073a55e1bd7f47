// Work divided into parts that each fit into the memory. Where only a whole part tells whether it fits, too large parts
// are cut; where pieces add up, one piece after another joins the part as long as it fits.
//
//   const auto parts = parts_that_fit(all, [&](const Block& b) { return bytes(b) <= memory; }, halves<Block>);
//
//   for (std::span<const Piece> left = pieces; !left.empty();) {
//     const auto run = longest_run(
//         left.size(), std::uint64_t{0}, [&](std::uint64_t sum, std::size_t i) { return sum + bytes(left[i]); },
//         [&](std::uint64_t sum) { return sum <= memory; });
//     ...                                             // left.first(run.count), which takes run.sum
//     left = left.subspan(run.count);
//   }
//
// Parts depend on the work and on what fits alone, and keep the work's order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <itin/precondition.hpp>

namespace itin::viewshed {

/// Returns the parts of `work` for which fits(part) holds. fits() is called once for each part, and may note in it what
/// it finds. cut(part) returns a pair of parts, and is called where fits() does not hold. It must throw where the part
/// cannot be cut, unless all such parts fit.
template <class Work, class Fits, class Cut>
std::vector<Work> parts_that_fit(Work work, const Fits& fits, const Cut& cut) {
  std::vector<Work> parts, left;
  left.push_back(std::move(work));
  while (!left.empty()) {
    Work part = std::move(left.back());
    left.pop_back();
    if (fits(part)) {
      parts.push_back(std::move(part));
    } else {
      auto [first, rest] = cut(std::move(part));
      left.push_back(std::move(rest));
      left.push_back(std::move(first));
    }
  }
  return parts;
}

/// Pieces next to each other, and the sum of their costs.
template <class Sum>
struct Run {
  std::size_t count = 0;
  Sum sum;
};

/// Takes as many of `count` pieces, from the first, as fit together, and at least one: a piece that does not fit alone
/// is a run of its own. add(sum, i) returns `sum` with piece `i` as well; `none` is the sum of no piece.
template <class Sum, class Add, class Fits>
Run<Sum> longest_run(std::size_t count, Sum none, const Add& add, const Fits& fits) {
  Run<Sum> run{0, std::move(none)};
  while (run.count < count) {
    Sum wider = add(run.sum, run.count);
    if (run.count > 0 && !fits(wider)) break;
    run = {run.count + 1, std::move(wider)};
  }
  return run;
}

/// Halves an ordered list of pieces; the first half is no longer than the second.
template <class Piece>
std::pair<std::span<Piece>, std::span<Piece>> halves(std::span<Piece> pieces) {
  return {pieces.first(pieces.size() / 2), pieces.subspan(pieces.size() / 2)};
}

/// Halves a rectangle of cells across its longer side; half(n) of the n columns or rows come first. Precondition: there
/// are at least two cells.
template <class Cells, class Half>
std::pair<Cells, Cells> halves(const Cells& cells, const Half& half) {
  ITIN_PRECONDITION(cells.columns * cells.rows >= 2);
  Cells first = cells, rest = cells;
  if (cells.columns >= cells.rows) {
    first.columns = half(cells.columns);
    rest.column += first.columns, rest.columns -= first.columns;
  } else {
    first.rows = half(cells.rows);
    rest.row += first.rows, rest.rows -= first.rows;
  }
  return {first, rest};
}

template <class Cells>
std::pair<Cells, Cells> halves(const Cells& cells) {
  return halves(cells, [](std::int64_t n) { return n / 2; });
}

}  // namespace itin::viewshed
