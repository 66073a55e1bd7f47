// What tables, calendars and sheets call dwellings and turbines.
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include <fmt/format.h>

#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

/// Returns "turbine 3", and its name where that is another.
inline std::string name_of_turbine(const Turbine& turbine) {
  const std::string number = fmt::format("{}", turbine.number);
  return fmt::format("turbine {}{}", number, turbine.name.empty() || turbine.name == number ? "" : " " + turbine.name);
}

/// Returns the dwelling's name, else its feature's; empty where it has neither.
inline const std::string& name_of_dwelling(const Dwelling& dwelling) {
  return dwelling.name.empty() ? dwelling.id : dwelling.name;
}

/// The turbines with flicker at a dwelling, ascending.
inline std::set<std::size_t> flickering_turbines(const Dwelling& dwelling) {
  std::set<std::size_t> turbines;
  for (const DwellingFacade& facade : dwelling.facades)
    for (const TurbineFlicker& flicker : facade.flicker) turbines.insert(flicker.turbine);
  return turbines;
}

}  // namespace itin::viewshed
