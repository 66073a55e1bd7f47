#include "import/point_intake.hpp"

#include <limits>
#include <utility>

#include <itin/call_progress.hpp>

#include "import/source/source_order.hpp"
#include "pyramid/pyramid.hpp"

namespace itin {

namespace {

std::vector<SourceRank> ranks_for_sorting(const std::vector<SourceInfo>& sources) {
  const std::vector<std::uint32_t> order = ranks_of(sources);
  std::vector<SourceRank> ranks;
  // Where both the sea and the ground have a post, the ground's counts.
  const auto spacing = [](const SourceInfo& s) {
    return is_sea(s) ? std::numeric_limits<double>::infinity() : s.spacing;
  };
  for (std::size_t s = 0; s < sources.size(); ++s)
    ranks.push_back(
        {spacing(sources[s]), is_ground(sources[s]), !sources[s].theme.empty(), order[s], sources[s].replaces});
  return ranks;
}

}  // namespace

PointIntake::PointIntake(const std::string& directory, std::uint64_t memory_bytes, Sources replacing)
    : all_(directory, replacing.empty() ? memory_bytes : memory_bytes / 2), replacing_(std::move(replacing)) {
  if (!replacing_.empty()) of_replacing_.emplace(directory, memory_bytes / 2);
}

void PointIntake::add(std::span<const RawPoint> points) {
  all_.add(points);
  if (!of_replacing_) return;
  for (const RawPoint& p : points)
    if (replacing_.contains(p.source)) of_replacing_->add(p);
}

void PointIntake::renumber(const std::vector<std::uint16_t>& numbers) {
  all_.renumber(numbers);
  if (of_replacing_) of_replacing_->renumber(numbers);
}

std::optional<ReplacingGround> PointIntake::replacing_ground(const std::vector<SourceInfo>& sources, const Grid& grid,
                                                             Progress& progress) {
  if (!of_replacing_) return std::nullopt;
  CallProgress call(progress);
  constexpr double kSorting = 0.2;
  SortedPoints points = of_replacing_->finish(ranks_for_sorting(sources), call.step(kSorting));
  of_replacing_.reset();
  return ReplacingGround(std::move(points), sources, grid, call.step(1));
}

SortedPoints PointIntake::finish(const std::vector<SourceInfo>& sources, Progress& progress,
                                 std::uint64_t* duplicates) {
  return all_.finish(ranks_for_sorting(sources), progress, duplicates);
}

}  // namespace itin
