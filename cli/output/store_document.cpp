#include "output/store_document.hpp"

#include <optional>

#include <fmt/format.h>

namespace itin::cli {

namespace {

std::vector<std::uint64_t> query_vertices(const StoreMetadata& metadata) {
  std::vector<std::uint64_t> counts(metadata.levels.size());
  std::uint64_t sum = 0;
  for (std::size_t i = counts.size(); i-- > 0;) counts[i] = sum += metadata.levels[i].vertices;
  return counts;
}

/// Tells whether a level after level 0 has right triangles about the posts of rasters.
std::optional<bool> has_right_triangles(const StoreMetadata& metadata, std::size_t level) {
  if (level == 0 || !metadata.right_triangle_levels) return std::nullopt;
  return level <= static_cast<std::size_t>(*metadata.right_triangle_levels);
}

}  // namespace

Document themes_document(const StoreMetadata& metadata) {
  Document themes = Document::array();
  for (const ThemeInfo& theme : metadata.themes) {
    Document fields = Document::array();
    for (const AttributeField& field : theme.fields)
      fields.push_back({{"name", field.name}, {"type", name_of(field.type)}});
    themes.push_back({{"name", theme.name},
                      {"kind", name_of(theme.kind)},
                      {"features", theme.features},
                      {"vertices", theme.vertices},
                      {"segments", theme.segments},
                      {"fields", std::move(fields)}});
    if (theme.is_raised()) themes.back()["left_out"] = theme.left_out_count();
    if (theme.wall_offset) themes.back()["wall_offset_m"] = *theme.wall_offset;
  }
  return themes;
}

std::string themes_table(const StoreMetadata& metadata) {
  if (metadata.themes.empty()) return fmt::format("{:<12}none\n", "themes");
  std::string table;
  for (const ThemeInfo& theme : metadata.themes) {
    table +=
        fmt::format("{:<12}{} ({}{}): {}{}, {}, {}{}\n", table.empty() ? "themes" : "", theme.name, name_of(theme.kind),
                    is_terrain(theme.kind) ? ", part of the terrain" : "", counted(theme.features, "feature"),
                    theme.left_out.empty() ? "" : fmt::format(", {} left out", grouped(theme.left_out_count())),
                    counted(theme.vertices, "vertex", "vertices"), counted(theme.segments, "segment"),
                    theme.fields.empty() ? "" : ", " + counted(theme.fields.size(), "field"));
  }
  return table;
}

Document levels_document(const StoreMetadata& metadata) {
  const std::vector<std::uint64_t> query = query_vertices(metadata);
  Document levels = Document::array();
  for (std::size_t i = 0; i < metadata.levels.size(); ++i) {
    const LevelInfo& level = metadata.levels[i];
    levels.push_back({{"tolerance_m", level.tolerance},
                      {"lateral_tolerance_m", level.lateral_tolerance},
                      {"vertices", level.vertices},
                      {"query_vertices", query[i]},
                      {"certified_error_m", error_interval(level.certified_error)}});
    if (const auto right = has_right_triangles(metadata, i)) levels.back()["right_triangles"] = *right;
  }
  return levels;
}

std::string levels_table(const StoreMetadata& metadata) {
  const std::vector<std::uint64_t> query = query_vertices(metadata);
  std::string table = fmt::format("{:>12} {:>15} {:>19}   {:<20} {}\n", "tolerance", "stored here", "read by a query",
                                  "certified error", "triangles on rasters");
  for (std::size_t i = 0; i < metadata.levels.size(); ++i) {
    const LevelInfo& level = metadata.levels[i];
    const std::string error = fmt::format("{:+.2f} to {:+.2f} m", level.certified_error.lo, level.certified_error.hi);
    const auto right = has_right_triangles(metadata, i);
    table += fmt::format("{:>10g} m {:>15} {:>19}   {}\n", level.tolerance, grouped(level.vertices), grouped(query[i]),
                         right ? fmt::format("{:<20} {}", error, *right ? "right ones" : "any") : error);
  }
  return table;
}

std::string readable_bytes(std::uint64_t bytes) {
  if (bytes < 1000) return counted(bytes, "byte");
  double amount = static_cast<double>(bytes);
  std::size_t unit = 0;
  constexpr const char* kUnits[] = {"bytes", "kB", "MB", "GB", "TB"};
  while (amount >= 999.95 && unit + 1 < std::size(kUnits)) amount /= 1000, ++unit;
  return fmt::format("{:.1f} {}", amount, kUnits[unit]);
}

}  // namespace itin::cli
