#include "import/source/source_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "pyramid/pyramid.hpp"

namespace itin {

std::vector<std::uint32_t> ranks_of(std::span<const SourceInfo> sources) {
  const auto key = [&](std::uint32_t s) {
    const SourceInfo& i = sources[s];
    return std::tuple(is_sea(i), !is_ground(i), i.spacing, i.gap_basis, i.replaces,
                      std::tie(i.kind, i.theme, i.sha256, i.path));
  };
  std::vector<std::uint32_t> order(sources.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> ranks(sources.size());
  for (std::uint32_t i = 1; i < order.size(); ++i)
    ranks[order[i]] = ranks[order[i - 1]] + (key(order[i - 1]) < key(order[i]) ? 1 : 0);
  return ranks;
}

std::vector<std::uint16_t> numbers_of(std::span<const SourceInfo> sources, const std::vector<bool>& left_out) {
  const std::vector<std::uint32_t> ranks = ranks_of(sources);
  const auto key = [&](std::uint16_t s) {
    const SourceInfo& i = sources[s];
    return std::tuple(!i.theme.empty(), ranks[s],
                      std::tie(i.makes_room, i.source_crs, i.note, i.wall_offset, i.heights_from, i.states_heights));
  };
  std::vector<std::uint16_t> order;
  for (std::uint16_t s = 0; s < sources.size(); ++s)
    if (!left_out[s]) order.push_back(s);
  std::stable_sort(order.begin(), order.end(), [&](std::uint16_t a, std::uint16_t b) { return key(a) < key(b); });
  std::vector<std::uint16_t> numbers(sources.size(), kNoSource);
  for (std::uint16_t n = 0; n < order.size(); ++n) numbers[order[n]] = n;
  return numbers;
}

}  // namespace itin
