// Proposed levels are those that the tiles of each wave choose as if the wave had none yet, and follow from heights
// near by.
#include "pyramid/levels/proposal.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "pyramid/coverage/coverage.hpp"
#include "pyramid/greedy/greedy.hpp"
#include "support/post_ground.hpp"
#include "support/seed.hpp"

namespace itin {
namespace {

using test::index_of, test::kHierarchyTolerances, test::levels_in, test::PostGround, test::random_ground;

constexpr std::uint32_t kPointsOfTile = 300;
const std::vector<double> kProposalTolerances(kHierarchyTolerances.begin(), kHierarchyTolerances.end());

std::vector<std::array<double, 4>> gaps_of(const PostGround& ground) {
  const double gap = 1.5 * ground.step;
  return {{gap, 0, 0, gap}};
}

/// A ground without lines, which are laid after levels are proposed.
PostGround ground_of_round(unsigned round, int columns = 0) {
  PostGround ground = random_ground(test::seed() + round, columns);
  ground.lines.clear();
  return ground;
}

/// What propose_levels() does, one tile after the other, on copies of the index.
class SlowProposal {
 public:
  SlowProposal(const PostGround& ground, const WorkingIndex& index, const PostHierarchy& posts)
      : ground_(ground), posts_(posts), tiles_(index.tiles(kPointsOfTile)) {
    for (const CurveRange& tile : tiles_) {
      for (const RawPoint& p : index.read(tile)) {
        points_[p.code] = {morton_x(p.code), morton_y(p.code), p.z};
        levels_[p.code] = p.level;
      }
    }
    for (const bool odd : {false, true}) {
      const std::map<std::uint64_t, int> before = levels_;
      for (const CurveRange& tile : tiles_)
        if (is_odd(tile) == odd) propose(tile, before);
    }
    for (const auto& [code, level] : beyond_) levels_[code] = std::max(levels_[code], level);
  }

  const std::map<std::uint64_t, int>& levels() const { return levels_; }
  /// The posts that are raised from where the hierarchy left them.
  const std::set<std::uint64_t>& raised() const { return raised_; }

 private:
  /// Whether a tile is a dark square of the chessboard of squares of its size.
  static bool is_odd(const CurveRange& tile) {
    const GridBox box = tile.cell.box();
    const std::int64_t side = std::int64_t{box.xmax} - box.xmin + 1;
    return (((std::int64_t{box.xmin} + kGridHalfSide) / side + (std::int64_t{box.ymin} + kGridHalfSide) / side) & 1) !=
           0;
  }

  void propose(const CurveRange& tile, const std::map<std::uint64_t, int>& before) {
    std::vector<test::LevelPoint> points;
    for (const auto& [code, point] : points_) points.push_back({point, before.at(code)});
    test::TestIndex index(points, static_cast<int>(kProposalTolerances.size()), 64);
    TileSurvey survey = survey_tile(*index, tile, gaps_of(ground_));
    const std::vector<SelectedVertex>& vertices = survey.surface.vertices;
    const int fine = posts_.coarsest_level();
    bool all_posts = fine > 0;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      if (survey.candidacy[v] == Candidacy::kNone) continue;
      const bool post = fine > 0 && posts_.has(vertices[v].position());
      all_posts = all_posts && post;
      if (post && survey.candidacy[v] == Candidacy::kFree && vertices[v].level < fine)
        survey.candidacy[v] = Candidacy::kSpare;
    }
    const std::size_t finest = all_posts ? static_cast<std::size_t>(fine) + 1 : 1;
    const std::vector<std::uint8_t> levels =
        survey.posts ? greedy_levels(vertices, *survey.posts, survey.candidacy, kProposalTolerances, finest)
                     : greedy_levels(survey.surface, survey.candidacy, kProposalTolerances, finest);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const std::uint64_t code = code_of(vertices[v]);
      const bool higher = levels[v] > vertices[v].level;
      if (tile.cell.contains(code)) {
        levels_[code] = levels[v];
      } else if (higher && survey.verge.contains(vertices[v].point.x, vertices[v].point.y)) {
        if (is_odd(tile) && !is_odd(tile_of(code))) beyond_.emplace_back(code, levels[v]);
      } else {
        continue;
      }
      if (higher && vertices[v].level < fine) raised_.insert(code);
    }
  }

  const CurveRange& tile_of(std::uint64_t code) const {
    return *std::find_if(tiles_.begin(), tiles_.end(), [&](const CurveRange& t) { return t.cell.contains(code); });
  }

  const PostGround& ground_;
  const PostHierarchy& posts_;
  std::vector<CurveRange> tiles_;
  std::map<std::uint64_t, GridPoint> points_;
  std::map<std::uint64_t, int> levels_;
  std::vector<std::pair<std::uint64_t, int>> beyond_;
  std::set<std::uint64_t> raised_;
};

TEST(Proposals, AreThoseOfOneTileAfterTheOther) {
  NoProgress progress;
  for (unsigned round = 0; round < 4; ++round) {
    SCOPED_TRACE(round);
    const PostGround ground = ground_of_round(round);
    test::TestIndex index = index_of(ground);
    const std::vector<CurveRange> tiles = index->tiles(kPointsOfTile);
    const PostHierarchy posts(*index, tiles, kHierarchyTolerances, progress);
    const SlowProposal slow(ground, *index, posts);
    const Proposal proposal = propose_levels(*index, tiles, gaps_of(ground), kProposalTolerances, posts, progress);
    for (const auto& [p, level] : levels_in(*index))
      ASSERT_EQ(level, slow.levels().at(code_of(p))) << p.x << ' ' << p.y;
    std::set<std::uint64_t> raised;
    for (const LevelRaise& raise : proposal.raised) raised.insert(raise.code);
    EXPECT_EQ(raised, slow.raised());
  }
}

/// The tiles that reach a tile or that it reaches, so many times over.
std::set<std::size_t> tiles_about(const std::vector<CurveRange>& tiles, std::size_t tile, int times) {
  std::set<std::size_t> near{tile};
  for (; times > 0; --times) {
    std::set<std::size_t> more = near;
    for (const std::size_t i : near) {
      for (std::size_t j = 0; j < tiles.size(); ++j) {
        if (reach_of(tiles[i]).meets(square_of(tiles[j].cell)) || reach_of(tiles[j]).meets(square_of(tiles[i].cell)))
          more.insert(j);
      }
    }
    near = std::move(more);
  }
  return near;
}

TEST(Proposals, FollowFromHeightsNearBy) {
  NoProgress progress;
  std::size_t same = 0, changed = 0;
  int compared = 0;
  for (unsigned round = 0; round < 8 && compared < 2; ++round) {
    SCOPED_TRACE(round);
    PostGround ground = ground_of_round(100 + round, 400);
    const std::int64_t end = (ground.first.column + 10) * ground.step;
    const auto propose = [&] {
      test::TestIndex index = index_of(ground);
      const std::vector<CurveRange> tiles = index->tiles(kPointsOfTile);
      const PostHierarchy posts(*index, tiles, kHierarchyTolerances, progress);
      propose_levels(*index, tiles, gaps_of(ground), kProposalTolerances, posts, progress);
      return std::tuple(posts.coarsest_level(), tiles, levels_in(*index));
    };
    const auto [fine, tiles, before] = propose();
    for (auto& [p, height] : ground.heights)
      if (p.x <= end) height = height % 37 * 11;
    const auto [fine_after, tiles_after, after] = propose();
    if (fine != fine_after) continue;  // the choice of fine levels is of the whole
    ++compared;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
      bool near = false;
      for (const std::size_t other : tiles_about(tiles, tile, kReachesOfProposal))
        near = near || square_of(tiles[other].cell).xmin <= end + PostHierarchy::kReach * ground.step;
      for (const auto& [p, level] : before) {
        if (!tiles[tile].cell.contains(code_of(p))) continue;
        if (near) {
          changed += after.at(p) != level ? 1 : 0;
        } else {
          ++same;
          ASSERT_EQ(after.at(p), level) << p.x << ' ' << p.y;
        }
      }
    }
  }
  EXPECT_GT(same, 0U) << "all tiles are near the change";
  EXPECT_GT(changed, 0U) << "the change is none";
}

}  // namespace
}  // namespace itin
