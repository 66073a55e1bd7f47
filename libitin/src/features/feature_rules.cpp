#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/theme.hpp>

namespace itin {

namespace {

constexpr std::array<std::string_view, 4> kRoofs{"flat", "gabled", "hipped", "skeleton"};
constexpr std::array<std::string_view, 4> kBases{"minimum", "mean", "maximum", "terrain-following"};

constexpr std::array<std::string_view, 3> kRoundings{"nearest", "up", "down"};

std::size_t index_of(std::string_view what, std::span<const std::string_view> names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(fmt::format("{} '{}': give one of {}", what, name, fmt::join(names, ", ")));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

RoofKind roof_kind(std::string_view name) {
  return static_cast<RoofKind>(index_of("roof", kRoofs, name));
}

BaseRule base_rule(std::string_view name) {
  return static_cast<BaseRule>(index_of("base", kBases, name));
}

HeightRounding height_rounding(std::string_view name) {
  return static_cast<HeightRounding>(index_of("rounding of heights", kRoundings, name));
}

}  // namespace itin
