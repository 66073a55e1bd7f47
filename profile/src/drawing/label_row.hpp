// Places names side by side in a row beside what they name, none over another.
//
//   for (const RowLabel& label : label_row(wanted, {.from = 52, .to = 1242})) draw(names[label.index], label.at);
#pragma once

#include <cstddef>
#include <vector>

namespace itin::profile {

/// The place that a name stands for, along the row.
struct RowPlace {
  double at = 0;
  double importance = 0;  ///< where not all names have room, the least important are left out
};

struct RowSpace {
  double from = 0, to = 0;
  double apart = 10;  ///< the least distance between two names
  double most = 60;   ///< how far a name may stand from its place
};

struct RowLabel {
  std::size_t index = 0;  ///< the index of the place
  double at = 0;
};

/// Returns the labels in the order along the row. A name is left out where no other arrangement of it and the more
/// important names has room for it. Among equally important names, the former goes first. Quadratic in the number of
/// places.
std::vector<RowLabel> label_row(const std::vector<RowPlace>& places, const RowSpace& space);

}  // namespace itin::profile
