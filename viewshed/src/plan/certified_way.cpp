#include "plan/certified_way.hpp"

#include <itin/lattice_reader.hpp>
#include <itin/level_choice.hpp>
#include <viewshed/exact_cost.hpp>
#include <viewshed/surface.hpp>

#include "request/request.hpp"
#include "request/request_window.hpp"

namespace itin::viewshed {

namespace {

/// A level that keeps at least one in this many points of the surface is looked at exactly.
constexpr std::uint64_t kLeastShare = 2;
/// Costs, counted in posts of an exact answer: of a point that is triangulated; of bounds, blocks and finer levels
/// about the observer.
constexpr std::uint64_t kPostsPerPoint = 40, kPostsPerBlocks = 2500000;
/// The cost, in posts, of a point that is triangulated for a viewshed at a tolerance, where most of the ground is
/// hidden.
constexpr std::uint64_t kPostsPerPlainPoint = 16;
/// Bounds know nothing of features, and decide far less among them, where they must be cheaper by this factor.
constexpr std::uint64_t kFeaturesFactor = 4;
/// A level of more than kMostPoints points takes over a gigabyte. It is looked at in sectors if it keeps fewer than one
/// in kVastShare points of the surface, and exactly otherwise.
constexpr std::uint64_t kMostPoints = 1500000, kVastShare = 128;

bool may_be_lattice(const Store& store, const Request& request, std::uint64_t points) {
  const std::uint64_t most_posts = ComputeOptions().memory_bytes / kBytesPerPost;
  return points <= most_posts && LatticeReader::may_open(store, window_of(request), ThemeChoice::none(), most_posts);
}

}  // namespace

CertifiedWay certified_way(const Store& store, const Request& request) {
  const int level = level_within(store.metadata(), request.detail.coarsest());
  const Box box = box_of_window(store, request);
  const std::uint64_t points = store.points_about(level, box), all = store.points_about(0, box);
  if (kLeastShare * points >= all) return CertifiedWay::kExactly;
  if (points > kMostPoints) return kVastShare * points < all ? CertifiedWay::kBySectors : CertifiedWay::kExactly;
  const bool features = has_raised_features(store, request);
  const std::uint64_t cost = (kPostsPerPoint * points + kPostsPerBlocks) * (features ? kFeaturesFactor : 1);
  if (cost >= kPostsPerPoint * all) return CertifiedWay::kExactly;
  return cost < all || features || !may_be_lattice(store, request, all) ? CertifiedWay::kByBlocks
                                                                        : CertifiedWay::kExactly;
}

bool exact_costs_no_more(const Store& store, const Request& request) {
  const double tolerance = request.detail.coarsest();
  if (tolerance == 0 || request.detail.rings().size() > 1 || has_raised_features(store, request)) return false;
  const Box box = box_of_window(store, request);
  const std::uint64_t points = store.points_about(level_within(store.metadata(), tolerance), box),
                      all = store.points_about(0, box);
  return kPostsPerPlainPoint * points >= all && may_be_lattice(store, request, all);
}

}  // namespace itin::viewshed
