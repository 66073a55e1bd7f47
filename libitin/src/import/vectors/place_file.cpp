#include "import/vectors/place_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/position_columns.hpp>
#include <itin/text_table.hpp>
#include <itin/written_position.hpp>

#include "gdal/files/archive.hpp"
#include "gdal/files/drivers.hpp"
#include "gdal/files/network.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/files/source_path.hpp"
#include "import/source/layers/source_layer.hpp"
#include "import/vectors/layer_crs.hpp"

namespace itin {

namespace {

bool is_text_table(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

/// Returns the contents of a file, GDAL's names of files within others, and addresses, included.
std::string contents_of(const std::string& path) {
  require_plain_file(path);
  const std::string name = path.starts_with("http://") || path.starts_with("https://") ? "/vsicurl/" + path : path;
  take_refusal();
  GByte* bytes = nullptr;
  vsi_l_offset size = 0;
  if (VSIIngestFile(nullptr, name.c_str(), &bytes, &size, -1) == 0) {
    require_no_refusal(path);
    throw FileError(path, why_not_read(path, "a table of places"));
  }
  const std::unique_ptr<GByte, decltype(&VSIFree)> owned(bytes, &VSIFree);
  return {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)};
}

/// Whether a cell is a number, and not a name such as 007.
bool is_number(const std::string& cell) {
  const bool padded = cell.size() > 1 && cell[0] == '0' && cell[1] != '.' && cell[1] != ',';
  return !padded && std::isfinite(number_in(cell).value_or(NAN));
}

/// Whether a column has numbers in all cells that are not empty, and has such.
template <class Rows>
bool holds_numbers(const Rows& rows, std::size_t column) {
  bool any = false;
  for (const auto& row : rows) {
    if (column >= row.cells.size() || row.cells[column].empty()) continue;
    if (!is_number(row.cells[column])) return false;
    any = true;
  }
  return any;
}

void set_field(OGRFeature& feature, int field, const std::string& cell) {
  if (feature.GetFieldDefnRef(field)->GetType() == OFTReal) {
    feature.SetField(field, *number_in(cell));
  } else {
    feature.SetField(field, cell.c_str());
  }
}

}  // namespace

PlaceFile::PlaceFile(const SiteQuery& query) : texts_(query.path) {
  const std::string path = within_archive(query.path);
  if (is_text_table(path)) {
    read_table(path);
  } else {
    dataset_ = open_vector_file(path, nullptr);
  }
  layer_ = &choose_layer(*dataset_, query.path, query.layer);
}

/// Reads a text table into a layer without geometry, so that conditions can be asked of it. A column that holds numbers
/// alone is one of numbers.
void PlaceFile::read_table(const std::string& path) {
  std::istringstream contents(contents_of(path));
  TextTable table(contents, path);
  if (!table.next()) throw FileError(path, "holds no row");
  const std::vector<std::string> names(table.cells().begin(), table.cells().end());
  header_line_ = table.line();
  while (table.next()) rows_.push_back({table.line(), {table.cells().begin(), table.cells().end()}});
  table_warnings_ = table.warnings();

  dataset_.reset(written_driver("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer& layer = *dataset_->CreateLayer(std::filesystem::path(path).stem().c_str(), nullptr, wkbNone);
  for (std::size_t column = 0; column < names.size(); ++column) {
    OGRFieldDefn field(names[column].c_str(), holds_numbers(rows_, column) ? OFTReal : OFTString);
    layer.CreateField(&field);
  }
  for (const Row& row : rows_) {
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetFID(&row - rows_.data() + 1);
    for (std::size_t column = 0; column < std::min(names.size(), row.cells.size()); ++column)
      if (!row.cells[column].empty()) set_field(feature, static_cast<int>(column), row.cells[column]);
    if (layer.CreateFeature(&feature) != OGRERR_NONE) throw FileError(path, QuietGdal::message("cannot be kept"));
  }
}

const PlaceFile::Row* PlaceFile::row_of(const OGRFeature& feature) const {
  return rows_.empty() ? nullptr : &rows_[static_cast<std::size_t>(feature.GetFID() - 1)];
}

int PlaceFile::field(const std::string& name) const {
  constexpr std::size_t kOfShapefile = 10;
  if (const int index = layer_->GetLayerDefn()->GetFieldIndex(name.c_str()); index >= 0) return index;
  const std::vector<std::string> names = field_names(*layer_);
  auto index = column_named(names, name);
  if (!index && name.size() > kOfShapefile) index = column_named(names, name.substr(0, kOfShapefile));
  return index ? static_cast<int>(*index) : -1;
}

std::string PlaceFile::text(const OGRFeature& feature, int field) {
  if (field < 0) return {};
  if (const Row* row = row_of(feature)) {
    const auto column = static_cast<std::size_t>(field);
    return column < row->cells.size() ? row->cells[column] : "";
  }
  if (!feature.IsFieldSetAndNotNull(field)) return {};
  return texts_.plain(feature.GetFieldAsString(field), place_of(feature));
}

std::optional<double> PlaceFile::number(const OGRFeature& feature, int field) {
  if (field < 0) return std::nullopt;
  const OGRFieldType type = feature.GetFieldDefnRef(field)->GetType();
  const bool has_type = type == OFTInteger || type == OFTInteger64 || type == OFTReal;
  if (has_type && feature.IsFieldSetAndNotNull(field)) return feature.GetFieldAsDouble(field);
  const std::string cell = text(feature, field);
  if (cell.empty()) return std::nullopt;
  return number_in(cell).value_or(NAN);
}

std::string PlaceFile::place_of(const OGRFeature& feature) const {
  const Row* row = row_of(feature);
  const auto number = static_cast<std::uint64_t>(feature.GetFID());
  const bool as_expected = row == nullptr || row->line == header_line_ + number;
  return as_expected ? fmt::format("feature {}", feature.GetFID())
                     : fmt::format("feature {}, line {}", feature.GetFID(), row->line);
}

/// A decimal comma in a file with commas between its values would shift them from column to column unseen.
std::string PlaceFile::wrong_row(const OGRFeature& feature) const {
  const Row* row = row_of(feature);
  const auto columns = static_cast<std::size_t>(layer_->GetLayerDefn()->GetFieldCount());
  if (row == nullptr || row->cells.size() <= columns) return {};
  const auto surplus = row->cells.begin() + static_cast<std::ptrdiff_t>(columns);
  if (std::all_of(surplus, row->cells.end(), [](const std::string& cell) { return cell.empty(); })) return {};
  return "it has more values than the header has columns; write numbers with a decimal point, texts with a comma in "
         "quotes";
}

std::vector<std::string> PlaceFile::warnings() const {
  std::vector<std::string> lines = table_warnings_;
  for (std::string& line : texts_.warnings()) lines.push_back(std::move(line));
  return lines;
}

Places::Places(PlaceFile& file, const SiteQuery& query, const std::string& to_crs)
    : file_(file), path_(query.path), to_crs_(to_crs) {
  if (file.is_table()) {
    const std::vector<std::string> names = field_names(file.layer());
    const auto pair = position_columns(names);
    if (pair) {
      columns_ = {static_cast<int>(pair->x), static_cast<int>(pair->y)};
      geographic_ = pair->geographic;
    } else if (const auto written = written_column(names)) {
      columns_ = {static_cast<int>(*written)};
    } else {
      wkt_ = file.field("WKT");
    }
  }
  LayerCrs crs = crs_of_layer(file.layer(), query.path, query.crs);
  if (!to_crs.empty()) crs_warning_ = std::move(crs.warning);
  std::string from_crs = std::move(crs.wkt);
  if (from_crs.empty() && geographic_) from_crs = kGeographicColumnsCrs;
  if (!from_crs.empty() && !to_crs.empty()) transform_.emplace(from_crs, to_crs);
}

Places::Found Places::find(const OGRFeature& feature) {
  if (std::string wrong = file_.wrong_row(feature); !wrong.empty()) return {{}, std::move(wrong)};
  try {
    return {positions_of(feature), {}};
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
}

std::vector<Point2> Places::positions_of(const OGRFeature& feature) {
  if (!columns_.empty()) return {of_columns(feature)};
  if (wkt_ >= 0) {
    OGRGeometry* geometry = nullptr;
    OGRGeometryFactory::createFromWkt(file_.text(feature, wkt_).c_str(), nullptr, &geometry);
    const std::unique_ptr<OGRGeometry> owned(geometry);
    if (!owned) throw InputError("its WKT is not understood");
    return points_of(*owned, feature);
  }
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (geometry != nullptr && !geometry->IsEmpty()) return points_of(*geometry, feature);
  throw InputError(file_.is_table()
                       ? fmt::format("it has no point; the header of a table must name {}", kPositionColumnsAdvice)
                       : "it has no point");
}

std::vector<Point2> Places::points_of(const OGRGeometry& geometry, const OGRFeature& feature) {
  std::vector<Point2> positions;
  const auto add = [&](const OGRPoint& point) {
    if (!std::isfinite(point.getX()) || !std::isfinite(point.getY())) throw InputError("its position is not finite");
    if (unused_height_.empty() && point.Is3D() && point.getZ() != 0)
      unused_height_ = fmt::format("{}: {:g}", file_.place_of(feature), point.getZ());
    positions.push_back(in_wanted_crs({point.getX(), point.getY()}));
  };
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPoint:
      add(*geometry.toPoint());
      return positions;
    case wkbMultiPoint:
      for (const OGRPoint* point : *geometry.toMultiPoint())
        if (!point->IsEmpty()) add(*point);
      if (positions.empty()) throw InputError("it has no point");
      return positions;
    default:
      throw InputError(fmt::format("it is a {}, not a point", geometry.getGeometryName()));
  }
}

/// Reads the position from its columns: numbers, degrees with minutes and seconds, or positions written in one cell.
Point2 Places::of_columns(const OGRFeature& feature) {
  if (columns_.size() == 1) return of_written(file_.text(feature, columns_[0]));
  return in_wanted_crs({coordinate(feature, columns_[0], "EW"), coordinate(feature, columns_[1], "NS")});
}

double Places::coordinate(const OGRFeature& feature, int field, const char* letters) {
  const std::string name = file_.layer().GetLayerDefn()->GetFieldDefn(field)->GetNameRef();
  const std::string text = file_.text(feature, field);
  if (text.empty()) throw InputError(fmt::format("its {} is empty or not a number", name));
  std::optional<double> value = number_in(text);
  if (!value && geographic_) value = written_angle(text, letters[0], letters[1]);
  if (value && std::isfinite(*value)) return *value;
  if (may_part_thousands(text))
    throw InputError(
        fmt::format("its position '{}' has a comma that may part thousands; write numbers with a decimal "
                    "point and no other mark",
                    text));
  throw InputError(fmt::format("its {} '{}' is not a number", name, text));
}

Point2 Places::of_written(const std::string& text) {
  const auto written = written_position(text);
  if (const auto xy = written ? std::nullopt : written_coordinates(text)) return in_wanted_crs(*xy);
  if (!written) throw InputError(fmt::format("its position '{}' is {}", text, kNoWrittenPosition));
  if (to_crs_.empty()) return written->position;
  return of_written_.try_emplace(written->crs, written->crs, to_crs_).first->second(written->position);
}

std::vector<std::string> Places::warnings() const {
  std::vector<std::string> lines;
  if (!crs_warning_.empty()) lines.push_back(crs_warning_);
  if (unused_height_.empty()) return lines;
  lines.push_back(fmt::format("{}: the Z of its points is not used ({}); heights come from a field or an option", path_,
                              unused_height_));
  return lines;
}

}  // namespace itin
