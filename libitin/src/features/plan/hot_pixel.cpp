#include "features/plan/hot_pixel.hpp"

#include <itin/precondition.hpp>

namespace itin {

namespace {

/// The parameters t of a segment that satisfy some inequalities: from `low` to `high`, fractions with positive
/// denominators, ends included or not.
class Interval {
 public:
  /// Keeps the t with start + t * step >= bound.
  void at_least(std::int64_t start, std::int64_t step, std::int64_t bound) {
    if (step == 0) {
      empty_ |= start < bound;
    } else if (step > 0) {
      raise({bound - start, step, true});
    } else {
      lower({start - bound, -step, true});
    }
  }

  /// Keeps the t with start + t * step < bound.
  void below(std::int64_t start, std::int64_t step, std::int64_t bound) {
    if (step == 0) {
      empty_ |= start >= bound;
    } else if (step > 0) {
      lower({bound - start, step, false});
    } else {
      raise({start - bound, -step, false});
    }
  }

  bool empty() const {
    const int order = compare(low_, high_);
    return empty_ || order > 0 || (order == 0 && !(low_.included && high_.included));
  }

 private:
  struct End {
    std::int64_t numerator, denominator;
    bool included;
  };
  static int compare(const End& a, const End& b) {
    const Int128 left = Int128{a.numerator} * b.denominator, right = Int128{b.numerator} * a.denominator;
    return (left > right) - (left < right);
  }
  void raise(const End& end) {
    const int order = compare(end, low_);
    if (order > 0 || (order == 0 && !end.included)) low_ = end;
  }
  void lower(const End& end) {
    const int order = compare(end, high_);
    if (order < 0 || (order == 0 && !end.included)) high_ = end;
  }

  End low_{0, 1, true}, high_{1, 1, true};
  bool empty_ = false;
};

}  // namespace

Position crossing_pixel(Position a, Position b, Position c, Position d) {
  // a + t (b - a) with t = area(a, c, d) / (area(a, c, d) - area(b, c, d)); areas are below 2^62, steps below 2^31.
  const Int128 from = doubled_area(c, d, a), to = doubled_area(c, d, b), whole = from - to;
  ITIN_PRECONDITION(from != 0 && to != 0 && (from < 0) != (to < 0));
  const auto along = [&](std::int32_t start, std::int32_t end) {
    return static_cast<std::int32_t>(start + rounded_quotient(from * (std::int64_t{end} - start), whole));
  };
  return {along(a.x, b.x), along(a.y, b.y)};
}

bool meets_pixel(Position a, Position b, Position p) {
  // Coordinates are doubled, so that the pixel's sides are whole.
  const std::int64_t ax = 2 * std::int64_t{a.x}, ay = 2 * std::int64_t{a.y};
  const std::int64_t dx = 2 * std::int64_t{b.x} - ax, dy = 2 * std::int64_t{b.y} - ay;
  const std::int64_t px = 2 * std::int64_t{p.x}, py = 2 * std::int64_t{p.y};
  Interval inside;
  inside.at_least(ax, dx, px - 1);
  inside.below(ax, dx, px + 1);
  inside.at_least(ay, dy, py - 1);
  inside.below(ay, dy, py + 1);
  return !inside.empty();
}

}  // namespace itin
