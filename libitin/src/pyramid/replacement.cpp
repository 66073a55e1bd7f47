#include "pyramid/replacement.hpp"

#include <algorithm>
#include <atomic>
#include <map>

#include <itin/parallel.hpp>

#include "pyramid/coverage/grounded.hpp"
#include "pyramid/pyramid.hpp"

namespace itin {

namespace {

/// Whether a source takes the place of another. All ground takes the place of the sea, and nothing makes room for the
/// sea. Ground of equal spacing, a new survey for instance, takes the place of ground that does not replace others
/// itself.
bool takes_place(const SourceInfo& source, const SourceInfo& of) {
  if (is_sea(source)) return false;
  if (is_sea(of)) return is_ground(source);
  return source.replaces && (source.spacing < of.spacing || (source.spacing == of.spacing && !of.replaces));
}

/// Returns for each source the sources that take its place. Empty sets are left out.
std::map<std::uint16_t, Sources> replacing(const std::vector<SourceInfo>& sources) {
  std::map<std::uint16_t, Sources> result;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    for (std::size_t r = 0; r < sources.size(); ++r) {
      if (!takes_place(sources[r], sources[s])) continue;
      result[static_cast<std::uint16_t>(s)].insert(static_cast<std::uint16_t>(r));
    }
  }
  return result;
}

}  // namespace

std::uint64_t drop_replaced(WorkingIndex& index, const std::vector<CurveRange>& tiles,
                            const std::vector<SourceInfo>& sources, const std::vector<std::array<double, 4>>& gap_bases,
                            const std::vector<std::uint64_t>& kept, Progress& progress) {
  const std::map<std::uint16_t, Sources> replaced_by = replacing(sources);
  if (replaced_by.empty()) return 0;
  std::map<Sources, SourceIndex> finer;
  for (const auto& [source, by] : replaced_by) finer.try_emplace(by, index, by);
  // All tiles are read before any is written: a point dropped here must not change what covers another tile's points.
  std::vector<std::vector<std::uint64_t>> dropped(tiles.size());
  std::atomic<std::size_t> done = 0;
  parallel_for(tiles.size(), [&](std::size_t i) {
    progress.throw_if_cancelled();
    std::map<Sources, std::vector<std::uint64_t>> candidates;
    for (const RawPoint& p : index.read(tiles[i])) {
      const auto found = replaced_by.find(p.source);
      if (found == replaced_by.end() || std::binary_search(kept.begin(), kept.end(), p.code)) continue;
      candidates[found->second].push_back(p.code);
    }
    for (const auto& [by, codes_of_tile] : candidates) {
      const std::vector<std::uint64_t> codes = grounded(codes_of_tile, finer.at(by), gap_bases);
      dropped[i].insert(dropped[i].end(), codes.begin(), codes.end());
    }
    progress.report("replacing coarser ground", static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  std::vector<std::uint64_t> all;
  for (const auto& codes : dropped) all.insert(all.end(), codes.begin(), codes.end());
  return index.drop(std::move(all));
}

}  // namespace itin
