#include "triangulate/region/window_leaves.hpp"

#include <algorithm>

#include <itin/parallel.hpp>

namespace itin {

namespace {

constexpr std::int64_t kStrips = 32;  ///< number of strips in the window's box, and of columns in each strip

/// Calls visit(first, last) for strip after strip of a range.
template <class Visit>
void for_each_strip(std::int32_t first, std::int32_t last, const Visit& visit) {
  const std::int64_t step = (std::int64_t{last} - first) / kStrips + 1;
  for (std::int64_t begin = first; begin <= last; begin += step)
    visit(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(std::min<std::int64_t>(last, begin + step - 1)));
}

/// Returns boxes that hold everything within the margin.
std::vector<GridBox> boxes_about(const GridWindow& window, double margin) {
  const GridBox all = expanded(window.bounds(), margin);
  std::vector<GridBox> boxes;
  for_each_strip(all.ymin, all.ymax, [&](std::int32_t ymin, std::int32_t ymax) {
    GridBox met;
    for_each_strip(all.xmin, all.xmax, [&](std::int32_t xmin, std::int32_t xmax) {
      const GridBox box{xmin, ymin, xmax, ymax};
      if (window.meets(expanded(box, margin))) met.extend(box);
    });
    if (!met.empty()) boxes.push_back(met);
  });
  return boxes;
}

}  // namespace

std::vector<Leaf> leaves_about(const PointIndex& index, const Selection& selection, const GridWindow& window,
                               double margin) {
  const std::vector<GridBox> boxes = boxes_about(window, margin);
  std::vector<std::vector<Leaf>> of_boxes(boxes.size());
  parallel_for(boxes.size(), [&](std::size_t i) {
    selected_leaves(index, selection, boxes[i], of_boxes[i]);
    // Leaves that meet an earlier box are left out, as they are listed there.
    std::erase_if(of_boxes[i], [&](const Leaf& leaf) {
      const GridBox box = leaf.cell.box();
      for (std::size_t k = i; k-- > 0 && boxes[k].ymax >= box.ymin;)
        if (boxes[k].meets(box)) return true;
      return false;
    });
    keep_leaves_about(window, margin, of_boxes[i]);
  });
  std::vector<Leaf> leaves;
  for (const std::vector<Leaf>& some : of_boxes) leaves.insert(leaves.end(), some.begin(), some.end());
  return leaves;
}

void keep_leaves_about(const GridWindow& window, double margin, std::vector<Leaf>& leaves) {
  std::erase_if(leaves, [&](const Leaf& leaf) { return !window.meets(expanded(leaf.cell.box(), margin)); });
}

}  // namespace itin
