#include "pyramid/levels/proposal.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include <itin/parallel.hpp>

#include "pyramid/coverage/coverage.hpp"
#include "pyramid/greedy/greedy.hpp"

namespace itin {

namespace {

/// Tiles that are proposed at the same time. The levels of a tile are held, a byte a point, until those have been
/// proposed that read its points.
constexpr std::size_t kProposedAtOnce = 32;

struct TileProposal {
  Proposal coverage;
  std::vector<std::uint8_t> levels;  ///< by the tile's points
  std::vector<LevelRaise> beyond;    ///< points across the border
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

TileProposal propose(const WorkingIndex& index, const CurveRange& tile, TileSurvey survey,
                     std::span<const double> tolerances, const PostHierarchy& posts) {
  const std::size_t finest = leave_fine_levels(posts, survey);
  const std::vector<SelectedVertex>& vertices = survey.surface.vertices;
  const std::vector<std::uint8_t> levels = levels_of(survey, tolerances, finest);
  TileProposal proposal{{std::move(survey.outline), std::move(survey.isolated), {}}, {}, {}};
  const std::vector<RawPoint> points = index.read(tile);
  for (const RawPoint& p : points) proposal.levels.push_back(static_cast<std::uint8_t>(p.level));
  std::size_t own_point = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const std::uint64_t code = code_of(vertices[v]);
    const bool own = tile.cell.contains(code);
    if (own) {
      while (points[own_point].code < code) ++own_point;
      proposal.levels[own_point] = levels[v];
    } else if (levels[v] > vertices[v].level && survey.verge.contains(vertices[v].point.x, vertices[v].point.y)) {
      proposal.beyond.push_back({code, levels[v]});
    } else {
      continue;
    }
    if (levels[v] > vertices[v].level && vertices[v].level < posts.coarsest_level())
      proposal.coverage.raised.push_back({code, levels[v]});
  }
  return proposal;
}

void write_proposed(WorkingIndex& index, const CurveRange& tile, const std::vector<std::uint8_t>& levels) {
  std::vector<RawPoint> points = index.read(tile);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].level != kDropped) points[i].level = levels[i];
  index.write(tile, points);
}

/// Tells whether a tile is of the second wave: the squares of a chessboard take turns.
bool is_second(const CurveRange& tile) {
  const std::uint64_t quarter = tile.cell.code >> (2 * tile.cell.log2_side);
  return ((quarter ^ quarter >> 1) & 1) != 0;
}

/// Proposes levels for the tiles of a wave as if none of them had any yet; `survey(tile)` gives the surface about a
/// tile.
template <class Survey>
void propose_wave(WorkingIndex& index, const std::vector<CurveRange>& tiles, const std::vector<std::size_t>& wave,
                  const Survey& survey, std::vector<TileProposal>& proposals) {
  // For each tile the tiles of the wave, by their places in it, whose points it reads.
  std::vector<std::vector<std::uint32_t>> reads(wave.size());
  parallel_for(wave.size(), [&](std::size_t i) {
    const GridBox reach = reach_of(tiles[wave[i]]);
    for (std::uint32_t j = 0; j < wave.size(); ++j)
      if (reach.meets(square_of(tiles[wave[j]].cell))) reads[i].push_back(j);
  });
  std::vector<std::uint32_t> readers(wave.size(), 0);
  for (const auto& read : reads)
    for (const std::uint32_t j : read) readers[j] += 1;
  for (std::size_t first = 0; first < wave.size(); first += kProposedAtOnce) {
    const std::size_t count = std::min(kProposedAtOnce, wave.size() - first);
    parallel_for(count, [&](std::size_t i) { proposals[wave[first + i]] = survey(tiles[wave[first + i]]); });
    std::vector<std::size_t> known;
    for (std::size_t i = first; i < first + count; ++i)
      for (const std::uint32_t j : reads[i])
        if (--readers[j] == 0) known.push_back(wave[j]);
    parallel_for(known.size(), [&](std::size_t i) {
      write_proposed(index, tiles[known[i]], std::exchange(proposals[known[i]].levels, {}));
    });
  }
}

/// Raises points that tiles of the second wave ask for across their borders, those of tiles of the first wave alone.
void raise_beyond(WorkingIndex& index, const std::vector<CurveRange>& tiles, std::vector<LevelRaise> raises) {
  std::erase_if(raises, [&](const LevelRaise& raise) {
    const auto after = std::upper_bound(tiles.begin(), tiles.end(), raise.code,
                                        [](std::uint64_t code, const CurveRange& t) { return code < t.cell.code; });
    return is_second(*std::prev(after));
  });
  index.promote(std::move(raises));
}

/// Proposes levels for all tiles; `survey(tile)` gives the surface about a tile.
template <class Survey>
std::vector<TileProposal> propose_all(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                                      std::span<const double> tolerances, const PostHierarchy& posts,
                                      Progress& progress, const Survey& survey) {
  std::vector<std::size_t> first, second;
  for (std::size_t i = 0; i < tiles.size(); ++i) (is_second(tiles[i]) ? second : first).push_back(i);
  std::vector<TileProposal> proposals(tiles.size());
  std::atomic<std::size_t> done = 0;
  const auto proposal_of = [&](const CurveRange& tile) {
    progress.throw_if_cancelled();
    TileProposal proposal = propose(index, tile, survey(tile), tolerances, posts);
    progress.report("choosing the levels", static_cast<double>(++done) / static_cast<double>(tiles.size()));
    return proposal;
  };
  propose_wave(index, tiles, first, proposal_of, proposals);
  propose_wave(index, tiles, second, proposal_of, proposals);
  std::vector<LevelRaise> beyond;
  for (const std::size_t tile : second)
    beyond.insert(beyond.end(), proposals[tile].beyond.begin(), proposals[tile].beyond.end());
  raise_beyond(index, tiles, std::move(beyond));
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
  return together(propose_all(index, tiles, tolerances, posts, progress,
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
  return together(propose_all(index, tiles, tolerances, posts, progress,
                              [&](const CurveRange& tile) { return survey_surface(index, tile); }));
}

}  // namespace itin
