#include "cross_section/ground_runs.hpp"

#include <algorithm>

#include <itin/error.hpp>

namespace itin {

namespace {

/// A box that holds more segments than this is halved: a diagonal line's box is mostly far from the line.
constexpr std::size_t kManySegments = 64;
constexpr int kMostHalvings = 10;

struct Crossed {
  OutlineCrossing crossing;
  bool enters = false;
};

class Collection {
 public:
  Collection(const PointIndex& index, const SectionLine& line, OnLine on_line)
      : index_(index), line_(line), on_line_(on_line) {
    collect(0, 1, kMostHalvings);
    const auto less = [](const Crossed& a, const Crossed& b) {
      return SectionLine::crossed_before(a.crossing.left, a.crossing.right, b.crossing.left, b.crossing.right);
    };
    // Segments at the border of two boxes come twice.
    const auto same = [](const Crossed& a, const Crossed& b) {
      return a.crossing.left == b.crossing.left && a.crossing.right == b.crossing.right;
    };
    std::sort(crossed_.begin(), crossed_.end(), less);
    crossed_.erase(std::unique(crossed_.begin(), crossed_.end(), same), crossed_.end());
  }

  GroundRuns runs() const {
    GroundRuns result;
    result.touches = touches_;
    if (crossed_.empty() || !crossed_.front().enters) result.runs.emplace_back();
    bool inside = !result.runs.empty();
    for (const Crossed& c : crossed_) {
      if (c.enters == inside) throw Error("the outline of the ground is not closed; run itin check on the store");
      if (c.enters) {
        result.runs.push_back({c.crossing, std::nullopt});
      } else {
        result.runs.back().exit = c.crossing;
      }
      inside = c.enters;
    }
    return result;
  }

 private:
  void collect(double t0, double t1, int halvings) {
    const GridBox box = line_.box(t0, t1);
    std::vector<Segment> found;
    index_.outline(box, found);
    if (found.size() > kManySegments && halvings > 0) {
      const double middle = (t0 + t1) / 2;
      collect(t0, middle, halvings - 1);
      collect(middle, t1, halvings - 1);
      return;
    }
    for (const Segment& s : found) add(s);
  }

  void add(const Segment& s) {
    const Position a = s.a(), b = s.b();
    const Int128 side_a = line_.side(a), side_b = line_.side(b);
    if ((side_a > 0 && side_b > 0) || (side_a < 0 && side_b < 0)) return;
    touches_ |= side_a == 0 || side_b == 0;
    const bool left_a = counts_as_left(side_a, on_line_), left_b = counts_as_left(side_b, on_line_);
    if (left_a == left_b) return;
    const SectionCrossing crossing = line_.crossing({a.x, a.y, 0}, side_a, {b.x, b.y, 0}, side_b);
    if (crossing.place != SectionCrossing::Place::kWithin) return;
    // Ground is to the left of ab; the places ahead are to the left of left -> right.
    crossed_.push_back(left_a ? Crossed{{a, b}, true} : Crossed{{b, a}, false});
  }

  const PointIndex& index_;
  const SectionLine& line_;
  OnLine on_line_;
  std::vector<Crossed> crossed_;
  bool touches_ = false;
};

}  // namespace

GroundRuns ground_runs(const PointIndex& index, const SectionLine& line, OnLine on_line) {
  return Collection(index, line, on_line).runs();
}

}  // namespace itin
