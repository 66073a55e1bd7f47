#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/grid_units.hpp>
#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/surface.hpp>

#include "index/visibility_sampler.hpp"
#include "progress/stage.hpp"

namespace itin::viewshed {

namespace {

/// The number of points of the surface on which the visibility index is measured.
constexpr std::uint64_t kPoints = 400000;
/// The number of random targets by which each post is judged ("20 to 30 random targets suffice").
constexpr unsigned kTargets = 2 * SightLines::kSize;
/// Posts tried in a square: the highest, and others spread over the rest.
constexpr std::size_t kHighest = 8, kOthers = 8;
constexpr double kMostSquares = 1e6;
/// The least height of a roof to stand on and the least area of its triangles; metres and square metres.
constexpr double kLeastRoofHeight = 3, kLeastRoofArea = 2;
/// A surface that rises by more than this above a post, metres, stands on the post.
constexpr double kStandsOnPost = 0.05;

/// A place where a site may stand.
struct Post {
  Point3 place;  ///< metres
  std::uint64_t seed = 0;
  bool summit = false, roof = false;
};

std::vector<bool> summits(const Tin& tin) {
  std::vector<bool> highest(tin.vertices.size(), true);
  for (const Triangle& t : tin.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (tin.vertices[a].z < tin.vertices[b].z) highest[a] = false;
      if (tin.vertices[b].z < tin.vertices[a].z) highest[b] = false;
    }
  }
  return highest;
}

bool is_raised(const Tin& tin, std::uint32_t vertex) {
  return !tin.raised_theme.empty() && tin.raised_theme[vertex] != 0;
}

/// Returns the vertices of the ground that nothing stands on, without vertices beside features where `tin` is the
/// surface itself.
std::vector<Post> posts_on_ground(const Tin& tin, const LineTester* surface) {
  std::vector<bool> beside(tin.vertices.size());
  for (const Triangle& t : tin.triangles) {
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t v) { return is_raised(tin, v); })) continue;
    for (const std::uint32_t v : t) beside[v] = true;
  }
  const auto is_free = [&](std::uint32_t v) {
    if (beside[v] || surface == nullptr) return !beside[v];
    const GridPoint& p = tin.vertices[v];
    const auto height = surface->height({static_cast<double>(p.x), static_cast<double>(p.y)});
    return height && (*height - p.z) * tin.grid.resolution <= kStandsOnPost;
  };
  const std::vector<bool> highest = summits(tin);
  std::vector<Post> posts;
  for (std::uint32_t v = 0; v < tin.vertices.size(); ++v)
    if (is_free(v)) posts.push_back({tin.point(v), tin.id(v), highest[v], false});
  return posts;
}

bool is_roof(const Tin& tin, const Triangle& t, const std::vector<ThemeInfo>& themes) {
  const std::uint16_t theme = tin.theme(t);
  if (theme == 0 || themes[theme - 1U].kind != ThemeKind::Buildings) return false;
  // Walls have a corner at their foot, which is not raised.
  if (!std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return is_raised(tin, v); })) return false;
  const Point3 a = tin.point(t[0]), b = tin.point(t[1]), c = tin.point(t[2]);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 2 * kLeastRoofArea;
}

/// Adds the middles of the triangles of roofs, rounded to the grid.
void add_roofs(const Store& store, const Tin& tin, const LineTester& surface, const LineTester& ground,
               std::vector<Post>& posts) {
  const Grid& units = tin.grid;
  for (const Triangle& t : tin.triangles) {
    if (!is_roof(tin, t, store.metadata().themes)) continue;
    Point2 middle;
    std::uint64_t seed = 0;
    for (const std::uint32_t v : t) {
      const GridPoint& p = tin.vertices[v];
      middle = {middle.x + p.x / 3.0, middle.y + p.y / 3.0};
      seed += tin.id(v);
    }
    middle = {std::round(middle.x), std::round(middle.y)};
    const auto roof = surface.height(middle), under = ground.height(middle);
    if (!roof || !under || (*roof - *under) * units.resolution < kLeastRoofHeight) continue;
    const Point2 place = place_in_metres(units, middle);
    posts.push_back({{place.x, place.y, *roof * units.resolution}, seed, true, true});
  }
}

class Proposer {
 public:
  /// Prepares the proposals. `surface` hides; `ground` is the ground under the features of the surface, or null where
  /// it has none.
  Proposer(const Store& store, const RetrievedSurface& surface, const RetrievedSurface* ground, const Window& area,
           const ProposalRequest& request)
      : area_(area),
        request_(request),
        surface_(surface, request.earth, kPoints * kTargets),
        squares_(RasterGrid::aligned(area.bounds(), request.spacing)) {
    if (ground != nullptr) ground_.emplace(*ground, request.earth, 0);
    const LineTester& bare = ground_ ? *ground_ : surface_;
    sampler_.emplace(surface_, request.targets_on_surface ? surface_ : bare,
                     VisibilitySampler::Targets{request.radius, request.target_height, kTargets}, NoData::kClear);
    if (ground != nullptr && !request.on_surface) {
      posts_ = posts_on_ground(ground->tin, &surface_);
    } else {
      posts_ = posts_on_ground(surface.tin, nullptr);
      add_roofs(store, surface.tin, surface_, bare, posts_);
    }
  }

  std::vector<Proposal> run(Progress& progress) const {
    const std::vector<std::vector<std::uint32_t>> posts = by_square();
    std::vector<std::vector<Proposal>> of_square(posts.size());
    for_each_step(posts.size(), "candidates", progress, [&](std::size_t i) { of_square[i] = propose(posts[i]); });
    std::vector<Proposal> all;
    for (const auto& some : of_square) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

 private:
  std::vector<std::vector<std::uint32_t>> by_square() const {
    std::vector<std::vector<std::uint32_t>> posts(squares_.cell_count());
    for (std::uint32_t i = 0; i < posts_.size(); ++i) {
      const Point2 place = plan(i);
      const auto square = squares_.cell_at(place);
      if (square && area_.contains(place)) posts[squares_.index(*square)].push_back(i);
    }
    return posts;
  }

  std::vector<Proposal> propose(std::vector<std::uint32_t> posts) const {
    if (posts.empty()) return {};
    std::stable_sort(posts.begin(), posts.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return posts_[a].place.z > posts_[b].place.z; });
    std::vector<std::uint32_t> tried(posts.begin(),
                                     posts.begin() + static_cast<std::ptrdiff_t>(std::min(posts.size(), kHighest)));
    const std::size_t step = std::max<std::size_t>(1, (posts.size() - tried.size()) / kOthers);
    for (std::size_t i = tried.size() + step / 2; i < posts.size(); i += step) tried.push_back(posts[i]);
    std::uint32_t best = tried.front();
    double most = -1;
    for (const std::uint32_t post : tried) {
      const double index = visibility_index(post);
      if (index > most) most = index, best = post;
    }
    std::vector<Proposal> result;
    const auto summit = std::find_if(posts.begin(), posts.end(), [&](std::uint32_t i) { return posts_[i].summit; });
    if (summit != posts.end()) result.push_back({plan(*summit), true, posts_[*summit].roof, visibility_index(*summit)});
    if (summit == posts.end() || best != *summit) result.push_back({plan(best), false, posts_[best].roof, most});
    return result;
  }

  Point2 plan(std::uint32_t post) const { return {posts_[post].place.x, posts_[post].place.y}; }

  /// Returns the share of targets seen; targets without ground are not seen.
  double visibility_index(std::uint32_t post) const {
    const auto& [place, seed, summit, roof] = posts_[post];
    const auto tally = sampler_->observe({place.x, place.y}, place.z + request_.mast_height, seed);
    return static_cast<double>(tally.seen) / tally.asked;
  }

  const Window& area_;
  const ProposalRequest& request_;
  LineTester surface_;
  std::optional<LineTester> ground_;
  std::optional<VisibilitySampler> sampler_;
  RasterGrid squares_;
  std::vector<Post> posts_;
};

}  // namespace

std::vector<Proposal> propose_sites(const Store& store, const Window& area, const ProposalRequest& request,
                                    Progress& progress) {
  Box box = area.bounds();
  if (box.width() / request.spacing * (box.height() / request.spacing) > kMostSquares)
    throw InputError(fmt::format("a spacing of {:g} m cuts the search area into more than {:g} squares: give a greater",
                                 request.spacing, kMostSquares),
                     "spacing");
  box = {box.xmin - request.radius, box.ymin - request.radius, box.xmax + request.radius, box.ymax + request.radius};
  const Detail detail = detail_of(store.metadata(), finest_level_of(store, box, kPoints));
  CallProgress call(progress);
  const Window window = Window::box(box);
  const RetrievedSurface ground{triangulate(store, window, detail, call.step(0.3)), nullptr, {}};
  if (ground.tin.triangles.empty()) throw InputError("the search area holds no ground", "search_area");
  std::optional<RetrievedSurface> raised;
  if (request.themes.includes_raised(store.metadata().themes))
    raised = RetrievedSurface{triangulate(store, window, detail, call.step(0.4), request.themes), nullptr, {}};
  std::vector<Proposal> proposals =
      Proposer(store, raised ? *raised : ground, raised ? &ground : nullptr, area, request).run(call.step(1));
  call.finish();
  if (proposals.empty()) throw InputError("the search area holds no ground", "search_area");
  return proposals;
}

}  // namespace itin::viewshed
