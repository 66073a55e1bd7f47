// A proposed wind farm among others: what of the zone is its own, and what it adds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/turbines.hpp>

namespace itin::viewshed {

/// Returns the number of turbines of this status.
std::size_t turbines_with(TurbineStatus status, const std::vector<Turbine>& turbines);
inline std::size_t proposed_turbines(const std::vector<Turbine>& turbines) {
  return turbines_with(TurbineStatus::kProposed, turbines);
}

/// Returns how many tips of proposed turbines are seen; kCountOutside outside.
std::vector<std::uint16_t> proposed_tips(const Zone& zone, const Visibility& visibility);

/// What of a proposal and of the others has a tip seen from a cell.
enum class Addition : std::uint8_t { kNone, kOthersAlone, kBoth, kProposalAlone };
inline constexpr std::uint8_t kNoAddition = 255;  ///< outside
struct AdditionClass {
  const char* text;
  Rgba colour;
};
inline constexpr std::array<AdditionClass, 4> kAdditions{{{"none", kTransparent},
                                                          {"other turbines alone", {86, 180, 233}},
                                                          {"the proposal and others", {204, 121, 167}},
                                                          {"the proposal alone: additional area", {213, 94, 0}}}};
/// Returns an Addition, or kNoAddition, for each cell.
std::vector<std::uint8_t> additions(const Zone& zone, const Visibility& visibility);

}  // namespace itin::viewshed
