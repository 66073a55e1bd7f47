#include "plan/certified_way.hpp"

#include <itin/lattice_reader.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/surface.hpp>

#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// A point of an envelope costs about as much as two of the full surface, or as so many posts of a lattice.
constexpr std::uint64_t kEnvelopeCosts = 2, kEnvelopeCostsInPosts = 128;
/// Lattices of at most so many posts take but a moment, whatever way is asked for.
constexpr std::uint64_t kFewPosts = 100000;
/// More take over a gigabyte: larger levels are looked at in sectors.
constexpr std::uint64_t kMostEnvelopePoints = 1500000;

}  // namespace

CertifiedWay certified_way(const Store& store, const Request& request) {
  if (features_stand(store, request)) return CertifiedWay::kExactly;
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const Box box = box_of_window(store, request);
  const std::uint64_t points = store.points_about(level, box), all = store.points_about(0, box);
  if (kEnvelopeCosts * points >= all) return CertifiedWay::kExactly;
  const bool large = points > kMostEnvelopePoints;
  if (kEnvelopeCostsInPosts * points < all) return large ? CertifiedWay::kBySectors : CertifiedWay::kAtOnce;
  const std::uint64_t most_posts = ComputeOptions().memory_bytes / kBytesPerPost;
  const bool exactly = large || (all > kFewPosts && all <= most_posts &&
                                 LatticeReader::may_open(store, window_of(request), ThemeChoice::none(), most_posts));
  return exactly ? CertifiedWay::kExactly : CertifiedWay::kAtOnce;
}

}  // namespace itin::viewshed
