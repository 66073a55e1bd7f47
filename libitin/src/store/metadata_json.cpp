#include "store/metadata_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include <itin/error.hpp>

#include "store/codec/byte_stream.hpp"
#include "store/codec/store_format.hpp"

namespace itin {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

// Writes a level. Certified errors are kept in grid units, so that no rounding comes between them and the cells' own.
ordered_json level_to_json(const LevelInfo& level, double resolution) {
  return {{"tolerance_m", level.tolerance},
          {"lateral_tolerance_m", level.lateral_tolerance},
          {"vertices", level.vertices},
          {"certified_error",
           {std::llround(level.certified_error.lo / resolution), std::llround(level.certified_error.hi / resolution)}}};
}

LevelInfo level_from_json(const json& j, double resolution) {
  LevelInfo level;
  level.tolerance = j.at("tolerance_m").get<double>();
  level.lateral_tolerance = j.at("lateral_tolerance_m").get<double>();
  level.vertices = j.at("vertices").get<std::uint64_t>();
  level.certified_error.lo = static_cast<double>(j.at("certified_error").at(0).get<std::int64_t>()) * resolution;
  level.certified_error.hi = static_cast<double>(j.at("certified_error").at(1).get<std::int64_t>()) * resolution;
  return level;
}

ordered_json scale_to_json(const GridScale& scale) {
  return {{"least", scale.least}, {"greatest", scale.greatest}, {"allowed_error", scale.allowed}};
}

GridScale scale_from_json(const json& j) {
  return {j.at("least").get<double>(), j.at("greatest").get<double>(), j.at("allowed_error").get<double>()};
}

ordered_json fields_to_json(const std::vector<AttributeField>& fields) {
  ordered_json j = ordered_json::array();
  for (const AttributeField& field : fields) j.push_back({{"name", field.name}, {"type", name_of(field.type)}});
  return j;
}

AttributeField field_from_json(const json& j) {
  const std::string type = j.at("type").get<std::string>();
  for (const AttributeType t : {AttributeType::number, AttributeType::whole, AttributeType::text})
    if (type == name_of(t)) return {j.at("name").get<std::string>(), t};
  throw DecodeError("a field is of no type");
}

std::vector<AttributeField> fields_from_json(const json& j) {
  std::vector<AttributeField> fields;
  for (const json& field : j) fields.push_back(field_from_json(field));
  return fields;
}

ordered_json source_to_json(const SourceInfo& source) {
  ordered_json j{{"path", source.path},         {"kind", source.kind},
                 {"theme", source.theme},       {"imported", source.imported},
                 {"sha256", source.sha256},     {"source_crs", source.source_crs},
                 {"vertices", source.vertices}, {"gap_basis_m", source.gap_basis},
                 {"spacing_m", source.spacing}, {"replaces", source.replaces}};
  if (source.makes_room) j["makes_room"] = true;
  if (!source.note.empty()) j["note"] = source.note;
  if (source.features > 0) j["features"] = source.features;
  if (!source.fields.empty()) j["fields"] = fields_to_json(source.fields);
  if (source.wall_offset) j["wall_offset_m"] = *source.wall_offset;
  if (!source.heights_from.empty()) j["heights_from"] = source.heights_from;
  if (!source.states_heights) j["states_heights"] = false;
  return j;
}

SourceInfo source_from_json(const json& j) {
  SourceInfo source;
  source.path = j.at("path").get<std::string>();
  source.kind = j.at("kind").get<std::string>();
  source.theme = j.value("theme", "");
  source.imported = j.at("imported").get<std::string>();
  source.sha256 = j.at("sha256").get<std::string>();
  source.source_crs = j.at("source_crs").get<std::string>();
  source.vertices = j.at("vertices").get<std::uint64_t>();
  source.gap_basis = j.at("gap_basis_m").get<std::array<double, 4>>();
  source.spacing = j.at("spacing_m").get<double>();
  source.replaces = j.at("replaces").get<bool>();
  source.makes_room = j.value("makes_room", false);
  source.note = j.value("note", "");
  source.features = j.value("features", std::uint64_t{0});
  source.fields = fields_from_json(j.value("fields", json::array()));
  if (j.contains("wall_offset_m")) source.wall_offset = j.at("wall_offset_m").get<double>();
  source.heights_from = j.value("heights_from", "");
  source.states_heights = j.value("states_heights", true);
  return source;
}

/// Writes a theme, without the members that a store without tables of features lacks.
ordered_json theme_to_json(const ThemeInfo& theme) {
  ordered_json j{{"name", theme.name},         {"kind", name_of(theme.kind)},
                 {"features", theme.features}, {"vertices", theme.vertices},
                 {"segments", theme.segments}, {"footprint_blocks", theme.footprint_blocks}};
  if (theme.feature_blocks > 0) j["feature_blocks"] = theme.feature_blocks;
  if (theme.segments_have_features) j["segments_have_features"] = true;
  if (theme.wall_offset) j["wall_offset_m"] = *theme.wall_offset;
  if (!theme.fields.empty()) j["fields"] = fields_to_json(theme.fields);
  for (const FeatureRun& run : theme.left_out) j["left_out"].push_back({run.first, run.last});
  return j;
}

/// Reads the features that do not stand, which ascend.
std::vector<FeatureRun> left_out_from_json(const json& j) {
  std::vector<FeatureRun> runs;
  for (const json& run : j) {
    const auto [first, last] = run.get<std::array<std::int64_t, 2>>();
    if (first > last || first < 0 || (!runs.empty() && first <= runs.back().last))
      throw DecodeError("features that are left out do not ascend");
    runs.push_back({first, last});
  }
  return runs;
}

ThemeInfo theme_from_json(const json& j) {
  try {
    ThemeInfo theme{j.at("name").get<std::string>(),
                    theme_kind(j.at("kind").get<std::string>()),
                    j.at("features").get<std::uint64_t>(),
                    j.at("vertices").get<std::uint64_t>(),
                    j.at("segments").get<std::uint64_t>(),
                    j.value("footprint_blocks", std::uint32_t{0}),
                    j.value("feature_blocks", std::uint32_t{0})};
    theme.segments_have_features = j.value("segments_have_features", false);
    if (j.contains("wall_offset_m")) theme.wall_offset = j.at("wall_offset_m").get<double>();
    theme.fields = fields_from_json(j.value("fields", json::array()));
    theme.left_out = left_out_from_json(j.value("left_out", json::array()));
    return theme;
  } catch (const InputError& e) {
    throw DecodeError(e.what());
  }
}

StoreMetadata read_document(const json& j) {
  StoreMetadata metadata;
  metadata.crs_wkt = j.at("crs_wkt").get<std::string>();
  metadata.grid.origin = {j.at("grid").at("origin_x").get<double>(), j.at("grid").at("origin_y").get<double>()};
  metadata.grid.resolution = j.at("grid").at("resolution_m").get<double>();
  const auto bounds = j.at("bounds").get<std::array<std::int32_t, 4>>();
  metadata.bounds = {bounds[0], bounds[1], bounds[2], bounds[3]};
  if (j.contains("scale")) metadata.scale = scale_from_json(j.at("scale"));
  for (const json& level : j.at("levels")) {
    metadata.levels.push_back(level_from_json(level, metadata.grid.resolution));
  }
  metadata.fine_levels = j.at("fine_levels").get<int>();
  if (j.contains("right_triangle_levels")) metadata.right_triangle_levels = j.at("right_triangle_levels").get<int>();
  for (const json& source : j.at("sources")) metadata.sources.push_back(source_from_json(source));
  for (const json& theme : j.at("themes")) metadata.themes.push_back(theme_from_json(theme));
  for (const json& part : j.at("parts"))
    metadata.parts.push_back(
        {part.at("theme").get<std::uint16_t>(), part.at("coarsest").get<int>(), part.value("clusters", false)});
  metadata.has_foundations = j.value("foundations", false);
  metadata.vertices = j.at("vertices").get<std::uint64_t>();
  return metadata;
}

}  // namespace

std::string metadata_to_json(const StoreMetadata& metadata) {
  ordered_json j;
  j["crs_wkt"] = metadata.crs_wkt;
  j["grid"] = {{"origin_x", metadata.grid.origin.x},
               {"origin_y", metadata.grid.origin.y},
               {"resolution_m", metadata.grid.resolution}};
  j["bounds"] = {metadata.bounds.xmin, metadata.bounds.ymin, metadata.bounds.xmax, metadata.bounds.ymax};
  if (metadata.scale) j["scale"] = scale_to_json(*metadata.scale);
  j["levels"] = ordered_json::array();
  for (const LevelInfo& level : metadata.levels) {
    j["levels"].push_back(level_to_json(level, metadata.grid.resolution));
  }
  j["fine_levels"] = metadata.fine_levels;
  if (metadata.right_triangle_levels) j["right_triangle_levels"] = *metadata.right_triangle_levels;
  j["sources"] = ordered_json::array();
  for (const SourceInfo& source : metadata.sources) j["sources"].push_back(source_to_json(source));
  j["themes"] = ordered_json::array();
  for (const ThemeInfo& theme : metadata.themes) j["themes"].push_back(theme_to_json(theme));
  j["parts"] = ordered_json::array();
  for (const ThemePart& part : metadata.parts) {
    j["parts"].push_back({{"theme", part.theme}, {"coarsest", part.coarsest}});
    if (part.has_clusters) j["parts"].back()["clusters"] = true;
  }
  if (metadata.has_foundations) j["foundations"] = true;
  j["vertices"] = metadata.vertices;
  // File names may have bytes that are not UTF-8.
  return j.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

StoreMetadata metadata_from_json(const std::string& text) {
  try {
    const StoreMetadata metadata = read_document(json::parse(text));
    if (metadata.levels.empty() || metadata.levels.size() > format::kMaxLevels || !(metadata.grid.resolution > 0) ||
        metadata.fine_levels < 1 || static_cast<std::size_t>(metadata.fine_levels) > metadata.levels.size() ||
        metadata.right_triangle_levels.value_or(0) < 0 ||
        static_cast<std::size_t>(metadata.right_triangle_levels.value_or(0)) >= metadata.levels.size() ||
        metadata.themes.size() + metadata.parts.size() > format::kMaxThemes ||
        !std::all_of(metadata.parts.begin(), metadata.parts.end(), [&](const ThemePart& part) {
          return part.theme >= 1 && part.theme <= metadata.themes.size() && part.coarsest >= 0 &&
                 static_cast<std::size_t>(part.coarsest) < metadata.levels.size();
        })) {
      throw DecodeError("describes no store");
    }
    return metadata;
  } catch (const json::exception& e) {
    throw DecodeError(e.what());
  }
}

}  // namespace itin
