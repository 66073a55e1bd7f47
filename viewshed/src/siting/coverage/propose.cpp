#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include <itin/call_progress.hpp>
#include <itin/error.hpp>
#include <itin/level_choice.hpp>
#include <itin/triangulate.hpp>
#include <viewshed/site_proposal.hpp>
#include <viewshed/surface.hpp>

#include "index/visibility_sampler.hpp"
#include "progress/stage.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

/// Points of the surface that the index is measured on.
constexpr std::uint64_t kPoints = 400000;
/// "20 to 30 random targets suffice".
constexpr unsigned kTargets = 2 * SightLines::kSize;
/// Posts tried in a square: the highest, and others spread over the rest.
constexpr std::size_t kHighest = 8, kOthers = 8;
constexpr double kMostSquares = 1e6;

bool within(const Window::Ring& ring, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point2 &a = ring[i], &b = ring[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside;
}

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

class Proposer {
 public:
  Proposer(const Surface& surface, const Window& area, const ProposalRequest& request)
      : tin_(surface.tin),
        area_(area),
        request_(request),
        surface_(surface, request.earth, kPoints * kTargets),
        sampler_(surface_, surface_, {request.radius, request.target_height, kTargets}, NoData::kClear),
        squares_(RasterGrid::aligned(area.bounds(), request.spacing)),
        summits_(summits(tin_)) {}

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
    for (std::uint32_t v = 0; v < tin_.vertices.size(); ++v) {
      const Point3 p = tin_.point(v);
      const auto square = squares_.cell_at({p.x, p.y});
      if (square && lies_in(area_, {p.x, p.y})) posts[squares_.index(*square)].push_back(v);
    }
    return posts;
  }

  std::vector<Proposal> propose(std::vector<std::uint32_t> posts) const {
    if (posts.empty()) return {};
    std::stable_sort(posts.begin(), posts.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return tin_.vertices[a].z > tin_.vertices[b].z; });
    std::vector<std::uint32_t> tried(posts.begin(),
                                     posts.begin() + static_cast<std::ptrdiff_t>(std::min(posts.size(), kHighest)));
    const std::size_t step = std::max<std::size_t>(1, (posts.size() - tried.size()) / kOthers);
    for (std::size_t i = tried.size() + step / 2; i < posts.size(); i += step) tried.push_back(posts[i]);
    std::uint32_t best = tried.front();
    double most = -1;
    for (const std::uint32_t v : tried) {
      const double index = visibility_index(v);
      if (index > most) most = index, best = v;
    }
    std::vector<Proposal> result;
    const auto summit = std::find_if(posts.begin(), posts.end(), [&](std::uint32_t v) { return summits_[v]; });
    if (summit != posts.end()) result.push_back({plan(*summit), true, visibility_index(*summit)});
    if (summit == posts.end() || best != *summit) result.push_back({plan(best), false, most});
    return result;
  }

  Point2 plan(std::uint32_t v) const {
    const Point3 p = tin_.point(v);
    return {p.x, p.y};
  }

  /// The share seen; what has no ground is not seen.
  double visibility_index(std::uint32_t v) const {
    const Point3 post = tin_.point(v);
    const auto tally = sampler_.observe({post.x, post.y}, post.z + request_.mast_height, tin_.id(v));
    return static_cast<double>(tally.seen) / tally.asked;
  }

  const Tin& tin_;
  const Window& area_;
  const ProposalRequest& request_;
  SampledSurface surface_;
  VisibilitySampler sampler_;
  RasterGrid squares_;
  std::vector<bool> summits_;
};

}  // namespace

bool lies_in(const Window& window, Point2 position) {
  if (window.is_all()) return true;
  return std::any_of(window.parts().begin(), window.parts().end(), [&](const Window::Polygon& part) {
    return within(part.outer, position) &&
           std::none_of(part.holes.begin(), part.holes.end(),
                        [&](const Window::Ring& hole) { return within(hole, position); });
  });
}

std::vector<Proposal> propose_sites(const Store& store, const Window& area, const ProposalRequest& request,
                                    Progress& progress) {
  Box box = area.bounds();
  if (box.width() / request.spacing * (box.height() / request.spacing) > kMostSquares)
    throw InputError(fmt::format("a spacing of {:g} m cuts the search area into more than {:g} squares: give a greater",
                                 request.spacing, kMostSquares));
  box = {box.xmin - request.radius, box.ymin - request.radius, box.xmax + request.radius, box.ymax + request.radius};
  const Detail detail = detail_of(store.metadata(), finest_level_of(store, box, kPoints));
  CallProgress call(progress);
  const Surface surface{triangulate(store, Window::box(box), detail, call.step(0.3)), nullptr, {}};
  if (surface.tin.triangles.empty()) throw InputError("the search area holds no ground");
  std::vector<Proposal> proposals = Proposer(surface, area, request).run(call.step(1));
  call.finish();
  if (proposals.empty()) throw InputError("the search area holds no ground");
  return proposals;
}

}  // namespace itin::viewshed
