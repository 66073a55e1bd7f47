#include "output/store_document.hpp"

#include <fmt/format.h>

#include <itin/level_choice.hpp>

namespace itin::cli {

namespace {

std::vector<std::uint64_t> query_vertices(const StoreMetadata& metadata) {
  std::vector<std::uint64_t> counts(metadata.levels.size());
  std::uint64_t sum = 0;
  for (std::size_t i = counts.size(); i-- > 0;) counts[i] = sum += metadata.levels[i].vertices;
  return counts;
}

}  // namespace

Document error_interval(const CertifiedError& error) {
  return Document::array({error.lo, error.hi});
}

Document surface_document(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes) {
  Document surface{{"tolerance_m", detail.coarsest()},
                   {"certified_error_m", error_interval(certified_error(metadata, detail))}};
  if (detail.rings().size() > 1) {
    surface["centre"] = {{"x", detail.centre().x}, {"y", detail.centre().y}};
    for (const Ring& ring : detail.rings()) {
      surface["rings"].push_back({{"radius_m", ring.radius}, {"tolerance_m", ring.tolerance}});
    }
  }
  surface["themes"] = themes.names(metadata.themes);
  return surface;
}

Document used_sources_document(const std::vector<SourceInfo>& sources) {
  Document list = Document::array();
  for (const SourceInfo& source : sources) {
    list.push_back({{"path", source.path},
                    {"kind", source.kind},
                    {"sha256", source.sha256},
                    {"spacing_m", source.spacing},
                    {"note", source.note.empty() ? Document(nullptr) : Document(source.note)}});
  }
  return list;
}

Document themes_document(const StoreMetadata& metadata) {
  Document themes = Document::array();
  for (const ThemeInfo& theme : metadata.themes) {
    themes.push_back({{"name", theme.name},
                      {"kind", name_of(theme.kind)},
                      {"features", theme.features},
                      {"vertices", theme.vertices},
                      {"segments", theme.segments}});
  }
  return themes;
}

std::string themes_table(const StoreMetadata& metadata) {
  if (metadata.themes.empty()) return fmt::format("{:<12}none\n", "themes");
  std::string table;
  for (const ThemeInfo& theme : metadata.themes) {
    table +=
        fmt::format("{:<12}{} ({}{}): {}, {}, {}\n", table.empty() ? "themes" : "", theme.name, name_of(theme.kind),
                    is_terrain(theme.kind) ? ", part of the terrain" : "", counted(theme.features, "feature"),
                    counted(theme.vertices, "vertex", "vertices"), counted(theme.segments, "segment"));
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
  }
  return levels;
}

std::string levels_table(const StoreMetadata& metadata) {
  const std::vector<std::uint64_t> query = query_vertices(metadata);
  std::string table =
      fmt::format("{:>12} {:>15} {:>19}   {}\n", "tolerance", "stored here", "read by a query", "certified error");
  for (std::size_t i = 0; i < metadata.levels.size(); ++i) {
    const LevelInfo& level = metadata.levels[i];
    table += fmt::format("{:>10g} m {:>15} {:>19}   {:+.2f} to {:+.2f} m\n", level.tolerance, grouped(level.vertices),
                         grouped(query[i]), level.certified_error.lo, level.certified_error.hi);
  }
  return table;
}

Document box_document(const Box& box) {
  return {{"xmin", box.xmin}, {"ymin", box.ymin}, {"xmax", box.xmax}, {"ymax", box.ymax}};
}

std::string grouped(std::uint64_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

std::string counted(std::uint64_t number, std::string_view noun, std::string_view plural) {
  if (number == 1) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", grouped(number), noun) : fmt::format("{} {}", grouped(number), plural);
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
