#include "import/source/source_options.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>

namespace itin {

namespace {

using Kinds = unsigned;

constexpr Kinds only(SourceKind kind) {
  return 1u << static_cast<unsigned>(kind);
}

constexpr Kinds kRasters = only(SourceKind::raster), kLas = only(SourceKind::las), kText = only(SourceKind::text),
                kPoints = only(SourceKind::points), kContours = only(SourceKind::contours),
                kTerrainLines = only(SourceKind::terrain_lines), kGroundLines = only(SourceKind::ground_lines),
                kBuildings = only(SourceKind::buildings), kWalls = only(SourceKind::walls),
                kCityModels = only(SourceKind::city_model), kCanopies = only(SourceKind::canopy),
                kSurfaces = only(SourceKind::surface);
constexpr Kinds kTerrain = kRasters | kLas | kText | kPoints, kLines = kContours | kTerrainLines | kGroundLines,
                kFootprints = kBuildings | kWalls, kCells = kCanopies | kSurfaces;

struct Option {
  std::string_view name;
  bool (*given)(const ImportOptions&);
  Kinds serves;
};

constexpr std::array kOptions{
    Option{"to_crs", [](const ImportOptions& o) { return !o.to_crs.empty(); }, kTerrain | kLines},
    Option{"allow_mixed_vertical", [](const ImportOptions& o) { return o.allow_mixed_vertical; },
           kTerrain | kLines | kBuildings | kCityModels | kSurfaces},
    Option{"replace", [](const ImportOptions& o) { return o.replace; }, kTerrain},
    Option{"stay", [](const ImportOptions& o) { return o.stay; }, kContours | kTerrainLines},
    Option{"sea_level", [](const ImportOptions& o) { return o.sea_level.has_value(); }, kRasters},
    Option{"sea_area", [](const ImportOptions& o) { return !o.sea_area.empty(); }, kRasters},
    Option{"band", [](const ImportOptions& o) { return o.band.has_value(); }, kRasters | kCells},
    Option{"classes", [](const ImportOptions& o) { return !o.classes.empty(); }, kLas},
    Option{"max_gap", [](const ImportOptions& o) { return o.max_gap > 0; }, kLas | kText | kPoints | kContours},
    Option{"z_field", [](const ImportOptions& o) { return !o.z_field.empty(); },
           kText | kPoints | kContours | kTerrainLines},
    Option{"repair = false", [](const ImportOptions& o) { return !o.repair; }, kContours},
    Option{"layer", [](const ImportOptions& o) { return !o.layer.empty(); }, kPoints | kLines | kFootprints},
    Option{"where", [](const ImportOptions& o) { return !o.where.empty(); }, kPoints | kLines | kFootprints},
    Option{"height", [](const ImportOptions& o) { return o.height.has_value(); }, kFootprints},
    Option{"height_field", [](const ImportOptions& o) { return !o.height_field.empty(); }, kFootprints},
    Option{"height_from", [](const ImportOptions& o) { return !o.height_from.empty(); }, kFootprints},
    Option{"eaves_field", [](const ImportOptions& o) { return !o.eaves_field.empty(); }, kFootprints},
    Option{"name_field", [](const ImportOptions& o) { return !o.name_field.empty(); },
           kLines | kFootprints | kCityModels},
    Option{"id_field", [](const ImportOptions& o) { return !o.id_field.empty(); }, kLines | kFootprints | kCityModels},
    Option{"attributes", [](const ImportOptions& o) { return o.attributes.has_value(); },
           kLines | kFootprints | kCityModels},
    Option{"storey", [](const ImportOptions& o) { return o.storey.has_value(); }, kFootprints},
    Option{"thickness", [](const ImportOptions& o) { return o.thickness.has_value(); }, kFootprints},
    Option{"wall_offset", [](const ImportOptions& o) { return o.wall_offset.has_value(); },
           kFootprints | kCityModels | kCells},
    Option{"base_field", [](const ImportOptions& o) { return !o.base_field.empty(); }, kBuildings},
    Option{"base", [](const ImportOptions& o) { return o.base.has_value(); }, kBuildings | kCityModels},
    Option{"foundation", [](const ImportOptions& o) { return o.foundation.has_value(); }, kBuildings | kCityModels},
    Option{"height_step", [](const ImportOptions& o) { return o.height_step.has_value(); }, kCells},
    Option{"height_threshold", [](const ImportOptions& o) { return o.height_threshold.has_value(); }, kCells},
    Option{"height_rounding", [](const ImportOptions& o) { return o.height_rounding.has_value(); }, kCells},
    Option{"roof", [](const ImportOptions& o) { return o.roof.has_value(); }, kBuildings},
};

constexpr std::array<const char*, 12> kTitles{"rasters",
                                              "LAS",
                                              "delimited text",
                                              "layers of points",
                                              "contours",
                                              "lines with heights",
                                              "lines and outlines without heights",
                                              "buildings with heights",
                                              "terraces, walls and vegetation with heights",
                                              "CityJSON",
                                              "rasters of heights above the ground",
                                              "rasters of a digital surface model"};

std::vector<std::string> titles_of(Kinds kinds) {
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < kTitles.size(); ++i)
    if (kinds & (1u << i)) titles.emplace_back(kTitles[i]);
  return titles;
}

}  // namespace

void require_useful_options(const ImportOptions& options, std::span<const SourceKind> sources) {
  Kinds present = 0;
  for (const SourceKind kind : sources) present |= only(kind);
  for (const Option& option : kOptions) {
    if (!option.given(options) || (option.serves & present)) continue;
    throw InputError(fmt::format("`{}`: does nothing {}, only for {}; leave it out", option.name,
                                 present == 0 ? "without a source" : fmt::format("for {}", listed(titles_of(present))),
                                 fmt::join(titles_of(option.serves), ", ")),
                     std::string(option.name.substr(0, option.name.find(' '))));
  }
}

SourceKind kind_of_lines(ThemeKind kind) {
  if (kind == ThemeKind::Contours) return SourceKind::contours;
  return is_terrain(kind) ? SourceKind::terrain_lines : SourceKind::ground_lines;
}

}  // namespace itin
