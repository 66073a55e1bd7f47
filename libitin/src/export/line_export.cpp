#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/lower_case.hpp>
#include <itin/store.hpp>
#include <itin/tin_export.hpp>
#include <itin/vector_export.hpp>

#include "export/pending_file.hpp"
#include "features/feature_lines.hpp"
#include "store/feature_table.hpp"

namespace itin {

namespace {

using Type = VectorLayer::Type;
using Value = VectorLayer::Value;
static_assert(std::is_same_v<Value, AttributeValue>);

double length_of(const std::vector<Point3>& points) {
  double length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length;
}

Type type_of(AttributeType type) {
  constexpr Type kTypes[] = {Type::kNumber, Type::kWhole, Type::kText};
  return kTypes[static_cast<int>(type)];
}

/// Converts a value to its column's type. Sources of one theme may differ in a field's type; the theme's is the widest.
Value widened(const Value& value, Type type) {
  const auto* whole = std::get_if<std::int64_t>(&value);
  if (whole != nullptr && type == Type::kNumber) return static_cast<double>(*whole);
  if (whole != nullptr && type == Type::kText) return fmt::format("{}", *whole);
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && type == Type::kText) return fmt::format("{}", *number);
  return value;
}

/// The columns of all themes, and the columns of each theme's attributes.
class Columns {
 public:
  void add(const ThemeInfo& theme, std::uint16_t number) {
    std::vector<std::size_t>& places = places_[number];
    for (const AttributeField& field : theme.fields) {
      const auto [at, fresh] = attributes_.try_emplace(field.name, fields_.size());
      if (fresh) fields_.emplace_back(unused(field.name), type_of(field.type));
      Type& type = fields_[at->second].second;
      if (type != type_of(field.type)) type = Type::kText;
      places.push_back(at->second);
    }
  }

  const std::vector<std::pair<std::string, Type>>& fields() const { return fields_; }

  std::vector<Value> values(const FeatureLine& line, const std::string& theme, const FeatureRecord& record) const {
    std::vector<Value> values(fields_.size());
    values[0] = theme;
    if (!record.id.empty()) values[1] = record.id;
    if (!record.name.empty()) values[2] = record.name;
    values[3] = length_of(line.points);
    const std::vector<std::size_t>& places = places_.at(line.theme);
    for (std::size_t i = 0; i < record.values.size(); ++i)
      values[places[i]] = widened(record.values[i], fields_[places[i]].second);
    return values;
  }

 private:
  /// Returns a name that no column has yet. Databases do not distinguish capitals in names, and have columns of their
  /// own.
  std::string unused(std::string name) const {
    const auto is_used = [&](const std::string& wanted) {
      const std::string lower = in_lower_case(wanted);
      return lower == "fid" || lower == "geom" || std::any_of(fields_.begin(), fields_.end(), [&](const auto& f) {
               return in_lower_case(f.first) == lower;
             });
    };
    while (is_used(name)) name += '_';
    return name;
  }

  std::vector<std::pair<std::string, Type>> fields_{
      {"theme", Type::kText}, {"feature_id", Type::kText}, {"feature_name", Type::kText}, {"length_m", Type::kNumber}};
  std::map<std::string, std::size_t> attributes_;
  std::map<std::uint16_t, std::vector<std::size_t>> places_;
};

}  // namespace

void require_lines_output(const std::string& path, bool overwrite) {
  if (ending_of(path) != ".gpkg" && ending_of(path) != ".geojson")
    throw InputError(
        fmt::format("{}: lines are written as a GeoPackage or GeoJSON; end the name in .gpkg or .geojson", path));
  PendingFile::require_possible(path, overwrite);
}

std::vector<std::size_t> export_lines(const Store& store, const WindowLines& lines, const std::string& path,
                                      const TinExportOptions& options, Progress& progress) {
  require_lines_output(path, options.overwrite);
  const std::vector<ThemeInfo>& themes = store.metadata().themes;
  Columns columns;
  std::map<std::uint16_t, FeatureTable> tables;
  for (const std::uint16_t theme : lines.themes) {
    columns.add(themes[theme - std::size_t{1}], theme);
    tables.try_emplace(theme, store, theme);
  }
  std::vector<std::size_t> counts(lines.themes.size());
  VectorLayer layer{"lines", VectorLayer::Shape::kLines, columns.fields(), {}};
  for (FeatureLine& line : feature_lines(store, lines, progress)) {
    const FeatureRecord* known = line.feature ? tables.at(line.theme).at(*line.feature) : nullptr;
    std::vector<Value> values =
        columns.values(line, themes[line.theme - std::size_t{1}].name, known != nullptr ? *known : FeatureRecord());
    layer.features.push_back({std::move(line.points), std::move(values)});
    ++counts[static_cast<std::size_t>(std::find(lines.themes.begin(), lines.themes.end(), line.theme) -
                                      lines.themes.begin())];
  }
  if (ending_of(path) == ".geojson")
    write_geojson(path, options.crs_wkt, layer, options.overwrite);
  else
    write_geopackage(path, options.crs_wkt, {layer}, options.overwrite);
  return counts;
}

}  // namespace itin
