#include "workflows/premises/premises_rules.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/in_ring.hpp>

namespace itin::viewshed {

void complete_antennas(AntennaPlaces& antennas, std::optional<double> frequency_ghz) {
  constexpr double kLeastSpacing = 0.1;
  const auto require = [](bool right, const char* field, const char* what) {
    if (!right) throw InputError(fmt::format("`{}`: {}", field, what), field);
  };
  require(antennas.spacing >= kLeastSpacing, "spacing", "give 0.1 m or more");
  require(antennas.reveal > 0, "reveal", "give more than 0 m: an antenna within a wall serves nothing");
  require(antennas.storey > 0, "storey", "give more than 0 m");
  require(!antennas.poles.empty(), "poles", "give at least one height");
  std::sort(antennas.poles.begin(), antennas.poles.end());
  require(antennas.poles.front() >= 0, "poles", "give heights of 0 m or more");
  if (!frequency_ghz) return;
  // A Fresnel zone that ends on the surface has no clearance at all.
  std::erase(antennas.poles, 0);
  require(!antennas.poles.empty(), "poles",
          "with a `frequency_ghz` give a height above 0: no link from the roof is clear");
}

void warn_of_left_out(const StoreMetadata& metadata, const ThemeChoice& themes, std::vector<std::string>& warnings) {
  for (const ThemeInfo& theme : metadata.themes) {
    if (!is_of_buildings(theme) || !themes.includes(theme) || theme.left_out.empty()) continue;
    const std::uint64_t count = theme.left_out_count();
    warnings.push_back(fmt::format("{} not counted: the import of theme '{}' left {} out", counted(count, "building"),
                                   theme.name, count == 1 ? "it" : "them"));
  }
}

void require_buildings(const StoreMetadata& metadata, const ThemeChoice& themes, std::vector<std::string>& warnings) {
  const ThemeChoice named = themes.with_ground_lines();
  std::vector<std::string> flat;
  bool raised = false;
  for (const ThemeInfo& theme : metadata.themes) {
    if (!is_of_buildings(theme) || !named.includes(theme)) continue;
    raised = raised || theme.is_raised();
    if (!theme.is_raised()) flat.push_back(theme.name);
  }
  constexpr const char* kWhatToDo = "import them again with `height_field` or `height`";
  if (raised && !flat.empty())
    warnings.push_back(
        fmt::format("buildings of {} have no heights and are left out; {}", fmt::join(flat, ", "), kWhatToDo));
  warn_of_left_out(metadata, themes, warnings);
  if (raised) return;
  if (!flat.empty())
    throw InputError(fmt::format("`themes`: buildings of {} have no heights; {}", fmt::join(flat, ", "), kWhatToDo),
                     "themes");
  throw InputError("`themes`: none of them has buildings; import some with `kind` buildings, or choose their theme",
                   "themes");
}

MountRules mount_rules(const PremisesRequest& request, const StoreMetadata& metadata, const BuildingFoot& foot) {
  const double usual = std::max(0.05, 2 * metadata.grid.resolution);
  MountRules rules{request.spacing,
                   request.reveal,
                   request.setback,
                   metadata.themes[foot.theme - std::size_t{1}].wall_offset.value_or(usual),
                   {false}};
  for (const ThemeInfo& theme : metadata.themes) rules.of_buildings.push_back(is_of_buildings(theme));
  return rules;
}

Box box_about(const PremisesRequest& request, const BuildingFoot& foot) {
  const Box box = box_of_rings(foot.rings);
  const double margin = std::max(request.reveal, request.setback.value_or(0)) + 0.01;
  return {box.xmin - margin, box.ymin - margin, box.xmax + margin, box.ymax + margin};
}

}  // namespace itin::viewshed
