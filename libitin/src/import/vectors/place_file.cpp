#include "import/vectors/place_file.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <cpl_conv.h>
#include <cpl_csv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/position_columns.hpp>

#include "gdal/crs.hpp"
#include "import/source/source_layer.hpp"

namespace itin {

namespace {

bool is_csv(GDALDataset& file) {
  return file.GetDriver() != nullptr && EQUAL(file.GetDriver()->GetDescription(), "CSV");
}

std::optional<PositionColumns> columns_of(OGRLayer& layer) {
  return position_columns(field_names(layer));
}

/// The open options of the file. GDAL makes points of one pair of columns only, which it must be told on opening.
std::vector<std::string> open_options(const std::string& path, ColumnTypes types) {
  const GDALDatasetUniquePtr file = open_vector_file(path, nullptr);
  if (!is_csv(*file) || file->GetLayerCount() != 1) return {};
  std::vector<std::string> options;
  if (types == ColumnTypes::kDeclared) options.emplace_back("AUTODETECT_TYPE=YES");
  OGRLayer& layer = *file->GetLayer(0);
  const auto columns = columns_of(layer);
  if (!columns) return options;
  const std::vector<std::string> names = field_names(layer);
  options.push_back("X_POSSIBLE_NAMES=" + names[columns->x]);
  options.push_back("Y_POSSIBLE_NAMES=" + names[columns->y]);
  return options;
}

/// Tells what is wrong with a row that has more values than the header has names, or a position that may mean another
/// number; empty where nothing is. GDAL drops surplus values: a decimal comma in a file with commas between its values
/// would shift them from column to column unseen. It reads 318,000 as 318, just as it reads 318000,5 as 318000.5.
std::string wrong_values(const CPLStringList& cells, int columns, const std::vector<int>& position) {
  if (cells.size() > columns)
    return "it has more values than the header has columns; write numbers with a decimal point, texts with a comma in "
           "quotes";
  for (const int column : position)
    if (column < cells.size() && may_part_thousands(cells[column]))
      return fmt::format(
          "its position '{}' has a comma that may part thousands; write numbers with a decimal point and "
          "no other mark",
          cells[column]);
  return {};
}

/// Returns the rows of a CSV file that are wrong, by GDAL's numbers from 1, with what is wrong with them.
std::map<std::int64_t, std::string> wrong_rows(const std::string& path, const std::vector<int>& position) {
  std::map<std::int64_t, std::string> rows;
  const std::unique_ptr<VSILFILE, decltype(&VSIFCloseL)> file(VSIFOpenL(path.c_str(), "rb"), &VSIFCloseL);
  if (!file) return rows;
  const char* const first = CPLReadLineL(file.get());
  if (first == nullptr) return rows;
  const char separator = CSVDetectSeperator(first);
  VSIFSeekL(file.get(), 0, SEEK_SET);
  const int columns = CPLStringList(CSVReadParseLine2L(file.get(), separator)).size();
  for (std::int64_t row = 1;;) {
    char** const values = CSVReadParseLine2L(file.get(), separator);
    if (values == nullptr) return rows;
    const CPLStringList cells(values);
    if (cells.empty() || (cells.size() == 1 && *cells[0] == '\0')) continue;
    if (std::string wrong = wrong_values(cells, columns, position); !wrong.empty()) rows.emplace(row, std::move(wrong));
    ++row;
  }
}

}  // namespace

GDALDatasetUniquePtr open_place_file(const std::string& path, ColumnTypes types) {
  const std::vector<std::string> options = open_options(path, types);
  std::vector<const char*> list;
  for (const std::string& option : options) list.push_back(option.c_str());
  list.push_back(nullptr);
  return open_vector_file(path, list.data());
}

Places::Places(GDALDataset& file, OGRLayer& layer, const SiteQuery& query, const std::string& to_crs)
    : csv_(is_csv(file)) {
  const auto columns = csv_ ? columns_of(layer) : std::nullopt;
  if (columns) columns_ = {static_cast<int>(columns->x), static_cast<int>(columns->y)};
  if (csv_) wrong_rows_ = wrong_rows(query.path, columns_);
  const OGRSpatialReference* own = layer.GetSpatialRef();
  std::string from_crs = own != nullptr ? wkt_of(*own) : query.crs;
  if (from_crs.empty() && columns && columns->geographic) from_crs = kGeographicColumnsCrs;
  if (!from_crs.empty() && !to_crs.empty()) transform_.emplace(from_crs, to_crs);
}

/// Tells what is wrong with the feature's coordinates. GDAL reads a coordinate that is no number as 0, or leaves the
/// point out.
std::string Places::wrong_coordinate(const OGRFeature& feature) const {
  if (const auto wrong = wrong_rows_.find(feature.GetFID()); wrong != wrong_rows_.end()) return wrong->second;
  for (const int field : columns_) {
    const char* name = feature.GetFieldDefnRef(field)->GetNameRef();
    const std::string text = feature.IsFieldSetAndNotNull(field) ? feature.GetFieldAsString(field) : "";
    char* end = nullptr;
    const double value = CPLStrtod(text.c_str(), &end);
    if (text.empty()) return fmt::format("its {} is empty or not a number", name);
    if (*end != '\0' || !std::isfinite(value)) return fmt::format("its {} '{}' is not a number", name, text);
  }
  return {};
}

std::string Places::find(const OGRFeature& feature, Point2& place) const {
  if (std::string wrong = wrong_coordinate(feature); !wrong.empty()) return wrong;
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry == nullptr || geometry->IsEmpty())
    return csv_ && columns_.empty()
               ? fmt::format("it has no point; the header of a CSV file must name {}", kPositionColumnsAdvice)
               : "it has no point";
  const OGRPoint* point = nullptr;
  if (wkbFlatten(geometry->getGeometryType()) == wkbPoint) point = geometry->toPoint();
  if (wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint && geometry->toMultiPoint()->getNumGeometries() == 1)
    point = geometry->toMultiPoint()->getGeometryRef(0);
  if (point == nullptr) return fmt::format("it is a {}, not a point", geometry->getGeometryName());
  place = {point->getX(), point->getY()};
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return "its position is not finite";
  try {
    if (transform_) place = (*transform_)(place);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace itin
