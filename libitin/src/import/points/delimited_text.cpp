#include "import/points/delimited_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/counted.hpp>
#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/plain_text.hpp>
#include <itin/position_columns.hpp>
#include <itin/text_table.hpp>

#include "import/source/middle_place.hpp"

namespace itin {

namespace {

constexpr std::string_view kHeightNames[] = {"z",   "height", "elevation", "elev",    "altitude",
                                             "alt", "h",      "point_z",   "z_coord", "zcoord"};

/// Whether a text looks like a number, even an invalid one such as one with a decimal comma: a line with it is no
/// header, but a bad row.
bool is_numeric(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("0123456789+-.,eE") == std::string_view::npos;
}

/// Quotes a text to fit in one line of a message.
std::string in_quotes(std::string_view text) {
  return fmt::format("'{}{}'", plain_text(text.substr(0, 60)), text.size() > 60 ? "..." : "");
}

/// Turns rows into points.
class RowParser {
 public:
  RowParser(const TextTable& table, const std::string& path, const std::array<std::size_t, 3>& columns)
      : table_(table), path_(path), columns_(columns), wanted_(most_of(columns)) {}

  /// The number of columns that a row must have.
  static std::size_t most_of(const std::array<std::size_t, 3>& columns) {
    return *std::max_element(columns.begin(), columns.end()) + 1;
  }

  /// Returns the point of the table's row; the height is NaN where its cell is empty.
  Point3 point() const {
    if (table_.cells().size() < wanted_)
      fail(fmt::format("{}, but {} are needed", counted(table_.cells().size(), "column"), wanted_));
    const bool no_height = table_.cells()[columns_[2]].empty();
    return {coordinate(0), coordinate(1), no_height ? std::numeric_limits<double>::quiet_NaN() : coordinate(2)};
  }

 private:
  double coordinate(std::size_t axis) const {
    const std::string_view cell = table_.cells()[columns_[axis]];
    const auto value = number_in(cell);
    if (!value || !std::isfinite(*value)) fail(fmt::format("{} is not a number", in_quotes(cell)));
    return *value;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {} in {}", path_, table_.line(), what, in_quotes(table_.row())));
  }

  const TextTable& table_;
  const std::string& path_;
  std::array<std::size_t, 3> columns_;
  std::size_t wanted_;
};

}  // namespace

DelimitedText::DelimitedText(std::string path, const std::string& z_field) : path_(std::move(path)) {
  TextTable table(path_, TextTable::Blanks::kBetweenCells);
  std::error_code error;
  size_ = static_cast<double>(std::filesystem::file_size(path_, error));
  if (error) throw FileError(path_, "is not a plain file");
  bool there = table.next();
  if (there) understand({table.cells().begin(), table.cells().end()}, z_field);
  if (there && has_header_) there = table.next();
  if (!there) throw FileError(path_, "holds no points");
  RowParser parse(table, path_, columns_);
  std::vector<Point2> places;
  for (; there && places.size() < kFirstPlaces; there = table.next()) {
    const Point3 point = parse.point();
    places.push_back({point.x, point.y});
  }
  centre_ = middle_place(std::move(places));
}

void DelimitedText::understand(const std::vector<std::string>& first, const std::string& z_field) {
  has_header_ = std::none_of(first.begin(), first.end(), is_numeric);
  if (has_header_)
    choose_columns(first, z_field);
  else if (!z_field.empty())
    throw FileError(path_, fmt::format("has no header line to find the column '{}' in", z_field));
}

void DelimitedText::choose_columns(const std::vector<std::string>& names, const std::string& z_field) {
  if (const auto position = position_columns(names)) {
    columns_ = {position->x, position->y, 0};
    geographic_ = position->geographic;
    columns_[2] = height_column(names, z_field);
    if (z_field.empty()) find_other_height(names);
    return;
  }
  if (names.size() < 3)
    throw FileError(path_, fmt::format("x, y and height need three columns; its header has {}", names));
  columns_[2] = height_column(names, z_field);
  warnings_.push_back(
      fmt::format("{}: x, y and height are taken from the columns {}, {} and {}; the header has no x and y", path_,
                  in_quotes(names[columns_[0]]), in_quotes(names[columns_[1]]), in_quotes(names[columns_[2]])));
}

/// Finds the column of the height. To be called once the columns of x and y are chosen.
std::size_t DelimitedText::height_column(const std::vector<std::string>& names, const std::string& z_field) const {
  const auto is_position = [&](std::size_t column) { return column == columns_[0] || column == columns_[1]; };
  if (!z_field.empty()) {
    if (const auto column = column_named(names, z_field)) return *column;
    throw FileError(path_, fmt::format("has no column '{}'; it has {}", z_field, names));
  }
  for (const std::string_view name : kHeightNames)
    if (const auto column = column_named(names, name); column && !is_position(*column)) return *column;
  if (names.size() > 2 && !is_position(2)) return 2;
  throw FileError(path_, fmt::format("has no column of heights among {}; name it with `z_field`", names));
}

/// To be called once all columns are chosen.
void DelimitedText::find_other_height(const std::vector<std::string>& names) {
  for (const std::string_view name : kHeightNames)
    if (const auto column = column_named(names, name);
        column && std::find(columns_.begin(), columns_.end(), *column) == columns_.end())
      other_height_ = names[*column];
}

std::string DelimitedText::warning() const {
  if (!level_ || other_height_.empty()) return {};
  return fmt::format("{0}: heights are 0 throughout; if they are in the column '{1}', give `z_field` {1}", path_,
                     other_height_);
}

std::uint64_t DelimitedText::read(const Sink& sink) {
  TextTable table(path_, TextTable::Blanks::kBetweenCells);
  if (has_header_) table.next();
  table.set_most_cells(RowParser::most_of(columns_));
  const RowParser row(table, path_, columns_);
  PointBatch batch;
  level_ = true;
  const auto hand_on = [&] {
    level_ = level_ && std::all_of(batch.z.begin(), batch.z.end(), [](double z) { return z == 0; });
    sink(batch, std::min(1.0, static_cast<double>(table.bytes_read()) / size_));
    batch.clear();
  };
  while (table.next()) {
    const Point3 point = row.point();
    batch.add(point.x, point.y, point.z);
    if (batch.size() == kPointBatchSize) hand_on();
  }
  if (batch.size() > 0) hand_on();
  return 0;
}

}  // namespace itin
