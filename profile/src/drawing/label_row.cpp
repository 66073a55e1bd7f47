#include "drawing/label_row.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace itin::profile {

namespace {

/// Whether there is room for all names, in the order along the row: each stands as far left as it can.
bool have_room(const std::vector<RowPlace>& places, const std::vector<std::size_t>& row, const RowSpace& space) {
  double free = space.from;
  return std::all_of(row.begin(), row.end(), [&](std::size_t i) {
    const double at = std::max(free, places[i].at - space.most);
    free = at + space.apart;
    return at <= std::min(places[i].at + space.most, space.to);
  });
}

}  // namespace

std::vector<RowLabel> label_row(const std::vector<RowPlace>& places, const RowSpace& space) {
  std::vector<std::size_t> order(places.size()), row;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[a].importance > places[b].importance; });
  for (const std::size_t i : order) {
    const auto next = std::find_if(row.begin(), row.end(), [&](std::size_t j) { return places[j].at > places[i].at; });
    const auto added = row.insert(next, i);
    if (!have_room(places, row, space)) row.erase(added);
  }
  std::vector<RowLabel> labels(row.size());
  // Each name is put at the rightmost place that leaves room for all that follow.
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t k = row.size(); k-- > 0;) {
    labels[k] = {row[k], std::min({limit, places[row[k]].at + space.most, space.to})};
    limit = labels[k].at - space.apart;
  }
  double free = space.from;
  for (RowLabel& label : labels) {
    label.at = std::min(label.at, std::max(free, places[label.index].at));
    free = label.at + space.apart;
  }
  return labels;
}

}  // namespace itin::profile
