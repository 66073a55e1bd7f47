#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <itin/error.hpp>
#include <viewshed/visibility_index.hpp>

#include "index/index_part.hpp"
#include "index/ray_index.hpp"
#include "index/ray_sums.hpp"
#include "index/target_index.hpp"

namespace itin::viewshed {

namespace {

void add_each(const std::vector<std::uint64_t>& from, std::vector<std::uint64_t>& to) {
  to.resize(std::max(to.size(), from.size()));
  std::transform(from.begin(), from.end(), to.begin(), to.begin(), std::plus());
}

}  // namespace

IndexShares::IndexShares(std::size_t cells)
    : share(cells, std::numeric_limits<float>::quiet_NaN()), standard_error(share), undecided(share) {}

IndexCounts& IndexCounts::operator+=(const IndexCounts& other) {
  any_eye = any_eye || other.any_eye;
  targets += other.targets, lines += other.lines, triangles += other.triangles, retrieval += other.retrieval;
  add_each(other.on_ground_of_ray, on_ground_of_ray), add_each(other.seen_of_ray, seen_of_ray);
  return *this;
}

IndexPart index_part(const Store& store, const IndexRequest& request, const IndexLayout& layout,
                     const CellRectangle& cells, Progress& progress) {
  return layout.sample.rays > 0 ? index_part_by_rays(store, request, layout, cells, progress)
                                : index_part_by_targets(store, request, layout, cells, progress);
}

void IndexSums::add(const IndexShares& shares) {
  for (std::size_t i = 0; i < shares.share.size(); ++i) {
    if (std::isnan(shares.share[i])) continue;
    ++observers;
    share.add(shares.share[i]);
    undecided.add(shares.undecided[i]);
    variance.add(double{shares.standard_error[i]} * shares.standard_error[i]);
  }
}

IndexMerge::IndexMerge(IndexLayout layout, Cells cells) : layout_(std::move(layout)) {
  if (cells == Cells::kKept) shares_.emplace(layout_.grid.cell_count());
}

void IndexMerge::add(const IndexPart& part) {
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[layout_.grid.index(part.cells.cell(i))] = from[i];
  };
  if (shares_) {
    copy(part.shares.share, shares_->share);
    copy(part.shares.standard_error, shares_->standard_error);
    copy(part.shares.undecided, shares_->undecided);
  }
  sums_.add(part.shares);
  counts_ += part.counts;
}

VisibilityIndex IndexMerge::take() {
  if (counts_.triangles == 0) throw InputError("the area holds no ground", "area");
  if (!counts_.any_eye)
    throw InputError("no cell's centre lies on ground in the area; give smaller cells", "cell_size");
  VisibilityIndex index;
  index.grid = layout_.grid, index.sample = layout_.sample;
  if (shares_) {
    index.share = std::move(shares_->share), index.standard_error = std::move(shares_->standard_error);
    index.undecided = std::move(shares_->undecided);
  }
  index.targets = counts_.targets, index.lines = counts_.lines;
  index.triangles = counts_.triangles, index.retrieval = counts_.retrieval;
  index.observers = sums_.observers;
  if (index.observers == 0)
    throw InputError("no target fell on ground: the radius reaches far beyond it; give a smaller one, or more targets",
                     "radius");
  const auto observers = static_cast<double>(index.observers);
  index.mean = sums_.share.value() / observers, index.mean_undecided = sums_.undecided.value() / observers;
  if (index.sample.rays > 0) {
    // Observers look in the same directions, and so err together.
    RaySums together;
    for (std::size_t ray = 0; ray < counts_.seen_of_ray.size(); ++ray)
      together.add(static_cast<double>(counts_.on_ground_of_ray[ray]), static_cast<double>(counts_.seen_of_ray[ray]));
    index.mean_error =
        together.standard_error(observers * RaySums::variance_of_looks(index.sample.rays, layout_.rings));
    const double everything = observers * index.sample.rays * layout_.rings * layout_.rings;
    index.ground = together.on_ground() / everything;
  } else {
    index.mean_error = std::sqrt(sums_.variance.value()) / observers;
    index.ground = static_cast<double>(index.lines) / static_cast<double>(index.targets);
  }
  return index;
}

VisibilityIndex visibility_index(const Store& store, const IndexRequest& request, Progress& progress) {
  const IndexLayout layout = lay_out_index(store, request, progress);
  IndexMerge merge(layout, IndexMerge::Cells::kKept);
  merge.add(index_part(store, request, layout, all_cells(layout.grid), progress));
  return merge.take();
}

}  // namespace itin::viewshed
