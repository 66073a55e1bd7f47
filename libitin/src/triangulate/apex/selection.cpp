#include "triangulate/apex/selection.hpp"

#include <algorithm>
#include <cmath>

#include <itin/int128.hpp>

namespace itin {

namespace {

// The farthest radius: far beyond every grid, yet squares and their sums still fit in 128 bits.
constexpr double kFarthest = 0x1p60;

std::int64_t rounded_units(double grid_units) {
  return std::llround(std::clamp(grid_units, -kFarthest, kFarthest));
}

int level_of(double tolerance, const std::vector<double>& tolerances) {
  const auto above = std::upper_bound(tolerances.begin() + 1, tolerances.end(), tolerance);
  return static_cast<int>(above - tolerances.begin()) - 1;
}

}  // namespace

Selection::Selection(const Detail& detail, const std::vector<double>& tolerances, const Grid& grid)
    : finest_(level_of(detail.finest(), tolerances)),
      coarsest_(level_of(detail.coarsest(), tolerances)),
      x_(rounded_units((detail.centre().x - grid.origin.x) / grid.resolution)),
      y_(rounded_units((detail.centre().y - grid.origin.y) / grid.resolution)) {
  for (std::size_t i = 0; i + 1 < detail.rings().size(); ++i) {
    const Ring& ring = detail.rings()[i];
    discs_.push_back({rounded_units(ring.radius / grid.resolution), level_of(ring.tolerance, tolerances)});
  }
}

int Selection::level_at(std::int64_t x, std::int64_t y) const {
  const Int128 dx = Int128{x} - x_, dy = Int128{y} - y_;
  const Int128 squared = dx * dx + dy * dy;
  for (const Disc& disc : discs_) {
    if (squared <= Int128{disc.radius} * disc.radius) return disc.level;
  }
  return coarsest_;
}

int Selection::finest_in(const GridBox& box) const {
  // Levels never fall with the distance from the centre, so the box's nearest position has the least.
  return level_at(std::clamp<std::int64_t>(x_, box.xmin, box.xmax), std::clamp<std::int64_t>(y_, box.ymin, box.ymax));
}

LevelRange Selection::levels_in(const GridBox& box) const {
  const std::int64_t x = x_ - box.xmin > box.xmax - x_ ? box.xmin : box.xmax,
                     y = y_ - box.ymin > box.ymax - y_ ? box.ymin : box.ymax;
  return {finest_in(box), level_at(x, y)};
}

void Selection::leave_out(std::uint16_t theme) {
  if (theme >= left_out_.size()) left_out_.resize(theme + std::size_t{1});
  left_out_[theme] = true;
}

bool Selection::selects(const Segment& s) const {
  if (!includes(s.theme)) return false;
  if (s.finest <= finest_ && coarsest_ <= s.coarsest) return true;
  const std::int64_t xmin = std::int64_t{std::min(s.ax, s.bx)} - s.reach,
                     xmax = std::int64_t{std::max(s.ax, s.bx)} + s.reach;
  const std::int64_t ymin = std::int64_t{std::min(s.ay, s.by)} - s.reach,
                     ymax = std::int64_t{std::max(s.ay, s.by)} + s.reach;
  const int nearest = level_at(std::clamp(x_, xmin, xmax), std::clamp(y_, ymin, ymax));
  const int farthest = level_at(x_ - xmin > xmax - x_ ? xmin : xmax, y_ - ymin > ymax - y_ ? ymin : ymax);
  return s.finest <= nearest && farthest <= s.coarsest;
}

Selection Selection::with_all_features() const {
  Selection all = *this;
  all.omitted_ = nullptr;
  return all;
}

Selection Selection::with_raised_alone(const StoreMetadata& metadata, std::uint16_t theme) const {
  Selection alone = with_all_features();
  for (std::size_t t = 0; t < metadata.themes.size(); ++t)
    if (metadata.themes[t].is_raised() && t + 1 != theme) alone.leave_out(static_cast<std::uint16_t>(t + 1));
  for (std::size_t p = 0; p < metadata.parts.size(); ++p)
    if (metadata.parts[p].theme != theme) alone.leave_out(static_cast<std::uint16_t>(metadata.themes.size() + p + 1));
  return alone;
}

Selection selection_of(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes) {
  themes.check(metadata.themes);
  std::vector<double> tolerances;
  for (const LevelInfo& level : metadata.levels) tolerances.push_back(level.tolerance);
  Selection selection(detail, tolerances, metadata.grid);
  for (std::size_t t = 0; t < metadata.themes.size(); ++t) {
    if (!themes.includes(metadata.themes[t])) selection.leave_out(static_cast<std::uint16_t>(t + 1));
  }
  for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
    const ThemePart& part = metadata.parts[p];
    // The finest level of all decides, as the surface must not depend on where one looks. In parts that have clusters,
    // ChosenClusters then leaves out the clusters that rings do not ask for.
    if (!selection.includes(part.theme) || part.coarsest < selection.finest())
      selection.leave_out(static_cast<std::uint16_t>(metadata.themes.size() + p + 1));
  }
  selection.omit(themes.omitted_tops());
  return selection;
}

void selected_leaves(const PointIndex& index, const Selection& selection, const GridBox& box, std::vector<Leaf>& out) {
  if (box.empty()) return;
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  index.leaves(selection.levels_in(box), box, out);
  const auto is_needless = [&](const Leaf& leaf) {
    if (leaf.theme != 0) return !selection.includes(leaf.theme);
    const LevelRange asked = selection.levels_in(intersection(leaf.cell.box(), box));
    return leaf.level < asked.finest || asked.coarsest < leaf.serves.finest || leaf.serves.coarsest < asked.finest;
  };
  out.erase(std::remove_if(out.begin() + first, out.end(), is_needless), out.end());
}

}  // namespace itin
