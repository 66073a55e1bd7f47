#include "triangulate/chosen_clusters.hpp"

#include "store/codec/store_format.hpp"

namespace itin {

namespace {

constexpr std::size_t kChosenCacheBytes = std::size_t{32} << 20;

}  // namespace

ChosenClusters::ChosenClusters(const Store& store, const Selection& selection)
    : file_(file_of(store)), selection_(selection), cache_(kChosenCacheBytes) {
  const StoreMetadata& metadata = store.metadata();
  coarsest_.assign(metadata.themes.size() + 1, kWhole);
  for (const ThemePart& part : metadata.parts)
    coarsest_.push_back(part.has_clusters && part.coarsest < selection.coarsest() ? part.coarsest : kWhole);
}

/// Tells for each item whether the query has one of the clusters that the item belongs to.
std::vector<bool> ChosenClusters::chosen_items(const LeafClusters& clusters, std::size_t items, int coarsest) const {
  std::vector<bool> chosen, items_chosen(items);
  for (const GridBox& box : clusters.boxes) chosen.push_back(selection_.finest_in(box) <= coarsest);
  for (const auto& [item, cluster] : clusters.items)
    if (chosen[cluster]) items_chosen[item] = true;
  return items_chosen;
}

std::shared_ptr<const Block> ChosenClusters::block(const Leaf& leaf) const {
  const int coarsest = this->coarsest(leaf.theme);
  if (coarsest == kWhole) return file_.block(leaf);
  if (auto cached = cache_.find(leaf.key)) return std::static_pointer_cast<const Block>(std::move(cached));
  const std::shared_ptr<const Block> whole = file_.block(leaf);
  const std::vector<bool> chosen =
      chosen_items(file_.read_clusters(leaf, extents_of(whole->points)), whole->points.size(), coarsest);
  auto kept = std::make_shared<Block>();
  for (std::size_t k = 0; k < whole->points.size(); ++k) {
    if (!chosen[k]) continue;
    kept->points.push_back(whole->points[k]);
    kept->sources.add(whole->sources[k]);
  }
  cache_.insert(leaf.key, kept, kept->bytes());
  return kept;
}

std::shared_ptr<const std::vector<Segment>> ChosenClusters::segments_of(const Leaf& leaf, int coarsest) const {
  if (auto cached = cache_.find(leaf.key))
    return std::static_pointer_cast<const std::vector<Segment>>(std::move(cached));
  const std::vector<Segment> whole = file_.read_edges(leaf);
  const std::vector<bool> chosen = chosen_items(file_.read_clusters(leaf, extents_of(whole)), whole.size(), coarsest);
  auto kept = std::make_shared<std::vector<Segment>>();
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (chosen[i]) kept->push_back(whole[i]);
  cache_.insert(leaf.key, kept, sizeof(*kept) + kept->size() * sizeof(Segment));
  return kept;
}

void ChosenClusters::segments(std::uint16_t theme, const GridBox& box, std::vector<Segment>& out) const {
  const int tree = format::edge_tree(theme), coarsest = this->coarsest(theme);
  if (coarsest == kWhole) return file_.segments_of(tree, box, out);
  std::vector<Leaf> leaves;
  file_.leaves_of(tree, box, leaves);
  for (const Leaf& leaf : leaves) {
    // This keeps the segments alive, as the cache has another copy if another thread has inserted the leaf first.
    const std::shared_ptr<const std::vector<Segment>> of_leaf = segments_of(leaf, coarsest);
    for (const Segment& s : *of_leaf)
      if (extent_of(s).meets(box)) out.push_back(s);
  }
}

}  // namespace itin
