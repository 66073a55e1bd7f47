// Places for the labels of a drawing such that none covers another.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <itin/geometry.hpp>

namespace itin {

/// A name beside a mark; lengths in the drawing's units.
struct MarkLabel {
  Point2 mark;          ///< the mark's middle
  double beside = 0;    ///< distance of the name from the mark's middle
  double width = 0;     ///< the name's width
  double height = 0;    ///< the height of its capitals
  double margin = 0.5;  ///< space that stays free about the name
};

class LabelPlaces {
 public:
  /// Marks a box as taken: no label may stand there any more.
  void take(const Box& box) { taken_.push_back(box); }
  bool free(const Box& box) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Box& t) {
      return t.xmin < box.xmax && box.xmin < t.xmax && t.ymin < box.ymax && box.ymin < t.ymax;
    });
  }
  /// Finds a place for the name: beside the mark, above it, below it, or at its upper corners, whichever is first
  /// within the frame and free. Takes it, and returns where the name's baseline begins, y downwards. Nothing: there is
  /// no room.
  std::optional<Point2> take_beside(const MarkLabel& label, const Box& frame) {
    const auto& [p, far, width, height, margin] = label;
    const Point2 anchors[] = {{p.x + far, p.y + height / 2},      {p.x - far - width, p.y + height / 2},
                              {p.x - width / 2, p.y - 1.2 * far}, {p.x - width / 2, p.y + 1.2 * far + height},
                              {p.x + 0.7 * far, p.y - 0.8 * far}, {p.x - 0.7 * far - width, p.y - 0.8 * far}};
    for (const Point2& anchor : anchors) {
      const Box box{anchor.x - margin, anchor.y - height, anchor.x + width + margin, anchor.y + margin};
      const bool within = frame.contains(Point2{box.xmin, box.ymin}) && frame.contains(Point2{box.xmax, box.ymax});
      if (!within || !free(box)) continue;
      take(box);
      return anchor;
    }
    return std::nullopt;
  }

 private:
  std::vector<Box> taken_;
};

/// Returns what a legend says about names without a place: "3 of 20 names left out for want of room".
inline std::string left_out_text(std::size_t left_out, std::size_t names) {
  return fmt::format("{} of {} names left out for want of room", left_out, names);
}

}  // namespace itin
