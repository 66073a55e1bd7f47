#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <viewshed/zone_files.hpp>

namespace itin::viewshed {

namespace {

constexpr std::array<Rgba, 8> kFarmColours{{{204, 41, 26},
                                            {0, 89, 178},
                                            {0, 133, 97},
                                            {153, 64, 153},
                                            {191, 115, 0},
                                            {26, 140, 191},
                                            {89, 89, 89},
                                            {105, 60, 20}}};

template <class IsOne>
TurbineGroup turbines_that(const std::vector<Turbine>& turbines, std::string name, const Rgba& colour,
                           const IsOne& is_one) {
  TurbineGroup group{std::move(name), colour, {}};
  for (std::size_t i = 0; i < turbines.size(); ++i)
    if (is_one(turbines[i])) group.turbines.push_back(i);
  return group;
}

const FeatureClass& status_class(TurbineStatus status) {
  return kTurbineStatuses[static_cast<std::size_t>(status)];
}

/// Returns the status that all turbines of a farm have.
std::optional<TurbineStatus> status_of_farm(const std::vector<Turbine>& turbines, const std::string& farm) {
  const auto is_of_farm = [&](const Turbine& t) { return t.farm == farm; };
  const auto first = std::find_if(turbines.begin(), turbines.end(), is_of_farm);
  const bool same =
      std::all_of(first, turbines.end(), [&](const Turbine& t) { return !is_of_farm(t) || t.status == first->status; });
  return same ? first->status : std::nullopt;
}

std::string name_of_farm(const std::vector<Turbine>& turbines, const std::string& farm) {
  const std::optional<TurbineStatus> status = status_of_farm(turbines, farm);
  if (!status) return farm;
  return farm.empty() ? status_class(*status).text : fmt::format("{}, {}", farm, status_class(*status).name);
}

/// Returns the farm that all turbines of a group are of.
std::optional<std::string> only_farm(const std::vector<Turbine>& turbines, const TurbineGroup& group) {
  const std::string& first = turbines[group.turbines.front()].farm;
  const bool same = std::all_of(group.turbines.begin(), group.turbines.end(),
                                [&](std::size_t i) { return turbines[i].farm == first; });
  return same ? std::optional(first) : std::nullopt;
}

std::vector<TurbineGroup> groups_by_status(const std::vector<Turbine>& turbines) {
  std::vector<TurbineGroup> groups;
  for (std::size_t s = 0; s < kTurbineStatuses.size(); ++s)
    groups.push_back(turbines_that(turbines, kTurbineStatuses[s].text, kTurbineStatuses[s].colour,
                                   [&](const Turbine& t) { return t.status == static_cast<TurbineStatus>(s); }));
  groups.push_back(turbines_that(turbines, "", kFarmColours.front(), [](const Turbine& t) { return !t.status; }));
  std::erase_if(groups, [](const TurbineGroup& group) { return group.turbines.empty(); });
  for (TurbineGroup& group : groups)
    if (const auto farm = only_farm(turbines, group)) group.name = name_of_farm(turbines, *farm);
  return groups;
}

}  // namespace

std::vector<std::string> farms_of(const std::vector<Turbine>& turbines) {
  std::vector<std::string> farms;
  for (const Turbine& t : turbines)
    if (std::find(farms.begin(), farms.end(), t.farm) == farms.end()) farms.push_back(t.farm);
  return farms;
}

std::vector<Rgba> farm_colours(const std::vector<Turbine>& turbines) {
  const std::size_t farms = farms_of(turbines).size();
  if (farms > kFarmColours.size()) return std::vector<Rgba>(farms, kFarmColours.front());
  return {kFarmColours.begin(), kFarmColours.begin() + static_cast<std::ptrdiff_t>(farms)};
}

const char* planning_status(const Turbine& turbine) {
  return turbine.status ? status_class(*turbine.status).name : "";
}

std::string turbine_style(const std::vector<Turbine>& turbines) {
  if (has_proposal(turbines)) return point_style("planning_status", kTurbineStatuses);
  const std::vector<std::string> farms = farms_of(turbines);
  const std::vector<Rgba> colours = farm_colours(turbines);
  std::vector<FeatureClass> classes;
  for (std::size_t f = 0; f < farms.size(); ++f)
    classes.push_back({farms[f].c_str(), farms[f].empty() ? "Turbine" : farms[f].c_str(), colours[f]});
  return point_style("farm", classes);
}

std::vector<TurbineGroup> turbine_groups(const std::vector<Turbine>& turbines) {
  const std::vector<std::string> farms = farms_of(turbines);
  if (farms.size() > kFarmColours.size()) return groups_by_status(turbines);
  std::vector<TurbineGroup> groups;
  for (std::size_t f = 0; f < farms.size(); ++f)
    groups.push_back(turbines_that(turbines, name_of_farm(turbines, farms[f]), kFarmColours[f],
                                   [&](const Turbine& t) { return t.farm == farms[f]; }));
  return groups;
}

}  // namespace itin::viewshed
