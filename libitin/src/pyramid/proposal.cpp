#include "pyramid/proposal.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <itin/parallel.hpp>

#include "pyramid/coverage.hpp"
#include "pyramid/greedy.hpp"

namespace itin {

namespace {

struct TileProposal {
  Proposal coverage;
  std::vector<LevelRaise> beyond;  ///< points across the border
};

std::vector<std::uint8_t> levels_of(const TileSurvey& survey, std::span<const double> tolerances, std::size_t finest) {
  return survey.posts ? greedy_levels(survey.surface.vertices, *survey.posts, survey.candidacy, tolerances, finest)
                      : greedy_levels(survey.surface, survey.candidacy, tolerances, finest);
}

/// Makes spare vertices of the posts that the hierarchy left out of the fine levels. Returns the finest level that is
/// still to be chosen.
std::size_t leave_fine_levels(const PostHierarchy& posts, TileSurvey& survey) {
  if (posts.coarsest_level() == 0) return 1;
  bool all = true;
  for (std::size_t v = 0; v < survey.candidacy.size(); ++v) {
    if (survey.candidacy[v] == Candidacy::kNone) continue;
    const SelectedVertex& vertex = survey.surface.vertices[v];
    if (!posts.has(vertex.position())) {
      all = false;
    } else if (survey.candidacy[v] == Candidacy::kFree && vertex.level < posts.coarsest_level()) {
      survey.candidacy[v] = Candidacy::kSpare;
    }
  }
  return all ? static_cast<std::size_t>(posts.coarsest_level()) + 1 : 1;
}

TileProposal propose(WorkingIndex& index, const CurveRange& tile, TileSurvey survey, std::span<const double> tolerances,
                     const PostHierarchy& posts) {
  const std::size_t finest = leave_fine_levels(posts, survey);
  const std::vector<SelectedVertex>& vertices = survey.surface.vertices;
  const std::vector<std::uint8_t> levels = levels_of(survey, tolerances, finest);
  TileProposal proposal{{std::move(survey.outline), std::move(survey.isolated), {}}, {}};
  std::vector<RawPoint> points = index.read(tile);
  auto p = points.begin();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::uint64_t code = code_of(vertices[v]);
    const bool own = tile.cell.contains(code);
    if (own) {
      while (p->code < code) ++p;
      p->level = levels[v];
    } else if (levels[v] > vertices[v].level && survey.verge.contains(vertices[v].point.x, vertices[v].point.y)) {
      proposal.beyond.push_back({code, levels[v]});
    } else {
      continue;
    }
    if (levels[v] > vertices[v].level && vertices[v].level < posts.coarsest_level())
      proposal.coverage.raised.push_back({code, levels[v]});
  }
  index.write(tile, points);
  return proposal;
}

/// Waves of tiles: in each, no tile lies within another one's reach. Tiles are served first come, first served along
/// the curve.
std::vector<std::vector<std::size_t>> waves(const std::vector<CurveRange>& tiles) {
  std::vector<GridBox> reaches;
  for (const CurveRange& tile : tiles) reaches.push_back(reach_of(tile));
  std::vector<std::vector<std::size_t>> result;
  std::vector<std::size_t> wave_of(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    std::vector<std::uint8_t> taken(result.size() + 1, 0);
    for (std::size_t j = 0; j < i; ++j) {
      if (reaches[i].meets(square_of(tiles[j].cell)) || reaches[j].meets(square_of(tiles[i].cell)))
        taken[wave_of[j]] = 1;
    }
    wave_of[i] = static_cast<std::size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (wave_of[i] == result.size()) result.emplace_back();
    result[wave_of[i]].push_back(i);
  }
  return result;
}

/// Raises points of tiles whose levels have been proposed; the others are still free to choose.
void raise_in_proposed(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                       const std::vector<std::uint8_t>& proposed, std::vector<LevelRaise> raises) {
  std::erase_if(raises, [&](const LevelRaise& raise) {
    const auto after = std::upper_bound(tiles.begin(), tiles.end(), raise.code,
                                        [](std::uint64_t code, const CurveRange& t) { return code < t.cell.code; });
    return !proposed[static_cast<std::size_t>(after - tiles.begin()) - 1];
  });
  index.promote(std::move(raises));
}

/// Proposes levels for all tiles, one wave after another; `survey(tile)` gives the surface about a tile.
template <class Survey>
std::vector<TileProposal> propose_in_waves(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                           std::span<const double> tolerances, const PostHierarchy& posts,
                                           Progress& progress, const Survey& survey) {
  std::vector<TileProposal> proposals(tiles.size());
  std::vector<std::uint8_t> proposed(tiles.size(), 0);
  std::atomic<std::size_t> done = 0;
  for (const std::vector<std::size_t>& wave : waves(tiles)) {
    parallel_for(wave.size(), [&](std::size_t i) {
      progress.throw_if_cancelled();
      const CurveRange& tile = tiles[wave[i]];
      proposals[wave[i]] = propose(index, tile, survey(tile), tolerances, posts);
      progress.report("choosing the levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
    });
    for (const std::size_t tile : wave) raise_in_proposed(index, tiles, proposed, proposals[tile].beyond);
    for (const std::size_t tile : wave) proposed[tile] = 1;
  }
  return proposals;
}

Proposal together(const std::vector<TileProposal>& proposals) {
  Proposal result;
  for (const TileProposal& p : proposals) {
    result.outline.insert(result.outline.end(), p.coverage.outline.begin(), p.coverage.outline.end());
    result.isolated.insert(result.isolated.end(), p.coverage.isolated.begin(), p.coverage.isolated.end());
    result.raised.insert(result.raised.end(), p.coverage.raised.begin(), p.coverage.raised.end());
  }
  return result;
}

}  // namespace

Proposal propose_levels(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                        const std::vector<std::array<double, 4>>& gap_bases, std::span<const double> tolerances,
                        const PostHierarchy& posts, Progress& progress) {
  return together(propose_in_waves(index, tiles, tolerances, posts, progress,
                                   [&](const CurveRange& tile) { return survey_tile(index, tile, gap_bases); }));
}

Proposal find_ground(const WorkingIndex& index, const std::vector<CurveRange>& tiles,
                     const std::vector<std::array<double, 4>>& gap_bases, const Sources* ground, Progress& progress) {
  std::optional<SourceIndex> points;
  if (ground != nullptr) points.emplace(index, *ground);
  std::vector<TileProposal> proposals(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    TileSurvey survey = survey_tile(index, tiles[i], gap_bases, points ? &*points : nullptr);
    proposals[i].coverage = {std::move(survey.outline), std::move(survey.isolated), {}};
    progress.report("finding the ground", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  return together(proposals);
}

Proposal propose_levels_with_lines(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                   std::span<const double> tolerances, const PostHierarchy& posts, Progress& progress) {
  return together(propose_in_waves(index, tiles, tolerances, posts, progress,
                                   [&](const CurveRange& tile) { return survey_surface(index, tile); }));
}

}  // namespace itin
