#include "triangulate/raised_index.hpp"

#include <algorithm>
#include <tuple>

#include "store/codec/store_format.hpp"
#include "triangulate/omitted_tops.hpp"

namespace itin {

namespace {

constexpr std::size_t kCacheBytes = std::size_t{64} << 20;

}  // namespace

RaisedIndex::RaisedIndex(const Store& store, const Selection& selection)
    : base_(store.points()), chosen_(store, selection), themes_(store.metadata().themes.size()), cache_(kCacheBytes) {
  const StoreMetadata& metadata = store.metadata();
  const auto last = static_cast<int>(themes_);
  ranks_.assign(themes_ + 1, last);
  for (std::size_t t = 1; t <= themes_; ++t)
    if (!selection.includes(static_cast<std::uint16_t>(t))) ranks_[t] = kNotThere;
  for (std::size_t p = 0; p < metadata.parts.size(); ++p) {
    const ThemeInfo& own = metadata.themes[metadata.parts[p].theme - std::size_t{1}];
    const bool chosen = selection.includes(static_cast<std::uint16_t>(themes_ + p + 1));
    const auto rank = std::count_if(metadata.themes.begin(), metadata.themes.end(), [&](const ThemeInfo& theme) {
      return theme.is_raised() && comes_before(theme, own);
    });
    themes_of_parts_.push_back(metadata.parts[p].theme);
    ranks_.push_back(chosen ? static_cast<int>(rank) : kNotThere);
    any_ = any_ || chosen;
  }
  if (any_ && selection.omitted()) beneath_ = selection.omitted()->ground(store, selection);
}

/// Returns the ascending codes of the places where vertices of rank `below` make way.
std::vector<std::uint64_t> RaisedIndex::masks(const GridBox& box, int below) const {
  std::vector<Leaf> leaves;
  base_.leaves({base_.level_count(), base_.level_count()}, box, leaves);
  std::vector<std::uint64_t> codes;
  for (const Leaf& leaf : leaves) {
    if (!is_part(leaf.theme) || rank(leaf.theme) == kNotThere || rank(leaf.theme) >= below) continue;
    // The block is held, as the cache may release it.
    const std::shared_ptr<const Block> block = chosen_.block(leaf);
    for (const GridPoint& p : block->points)
      if (box.contains(p.x, p.y)) codes.push_back(code_of(p));
  }
  std::sort(codes.begin(), codes.end());
  return codes;
}

std::shared_ptr<const Block> RaisedIndex::block(const Leaf& leaf) const {
  if (!any_) return base_.block(leaf);
  if (auto cached = cache_.find(leaf.key)) return std::static_pointer_cast<const Block>(std::move(cached));
  std::shared_ptr<const Block> whole = chosen_.block(leaf);
  const std::vector<std::uint64_t> masked = masks(leaf.cell.box(), rank(leaf.theme));
  if (masked.empty() && !is_part(leaf.theme)) return whole;
  auto rest = std::make_shared<Block>();
  rest->raised_theme = is_part(leaf.theme) ? themes_of_parts_[leaf.theme - themes_ - 1] : std::uint16_t{0};
  for (std::size_t k = 0; k < whole->points.size(); ++k) {
    const GridPoint& p = whole->points[k];
    if (is_part(leaf.theme) && whole->sources[k] == format::kMask) continue;
    if (is_part(leaf.theme) && beneath_ && beneath_->removes(p)) continue;
    const bool makes_way = std::binary_search(masked.begin(), masked.end(), code_of(p));
    if (makes_way && (is_part(leaf.theme) || !beneath_ || !beneath_->restores(p))) continue;
    const std::optional<std::int32_t> ground = is_part(leaf.theme) && beneath_ ? beneath_->lowered(p) : std::nullopt;
    rest->points.push_back({p.x, p.y, ground.value_or(p.z)});
    rest->sources.add(is_part(leaf.theme) ? static_cast<std::uint16_t>(whole->sources[k] & ~format::kOnOutline)
                                          : whole->sources[k]);
    if (is_part(leaf.theme)) rest->outline.push_back(ground || (whole->sources[k] & format::kOnOutline) != 0 ? 1 : 0);
    if (!whole->levels.empty()) rest->levels.push_back(whole->levels[k]);
  }
  cache_.insert(leaf.key, rest, rest->bytes());
  return rest;
}

void RaisedIndex::segments(const GridBox& box, std::vector<Segment>& out) const {
  if (!any_) return base_.segments(box, out);
  std::vector<Segment> found;
  for (std::size_t number = 0; number < ranks_.size(); ++number)
    if (ranks_[number] != kNotThere) chosen_.segments(static_cast<std::uint16_t>(number), box, found);
  using Name = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t>;
  const auto name = [](const Segment& s, std::int32_t theme) { return Name{s.ax, s.ay, s.bx, s.by, theme}; };
  std::vector<Name> masked;
  for (const Segment& s : found) {
    if (s.finest == format::kMaskedSegment) masked.push_back(name(s, s.reach));
  }
  std::sort(masked.begin(), masked.end());
  for (const Segment& s : found) {
    if (s.finest == format::kMaskedSegment || (beneath_ && beneath_->removes(s))) continue;
    if (!std::binary_search(masked.begin(), masked.end(), name(s, s.theme))) out.push_back(s);
  }
  if (beneath_) beneath_->segments(box, out);
}

}  // namespace itin
