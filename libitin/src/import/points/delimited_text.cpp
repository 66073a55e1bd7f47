#include "import/points/delimited_text.hpp"

#include <algorithm>
#include <charconv>
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
#include <itin/position_columns.hpp>

#include "import/source/line_reader.hpp"
#include "import/source/middle_place.hpp"

namespace itin {

namespace {

constexpr std::string_view kHeightNames[] = {"z",   "height", "elevation", "elev",    "altitude",
                                             "alt", "h",      "point_z",   "z_coord", "zcoord"};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Whether a line holds no point, just a remark or nothing.
bool is_skipped(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '#';
}

char separator_of(std::string_view line) {
  // Semicolons come first: where they separate the columns, commas are decimal.
  for (const char candidate : {';', '\t', ','})
    if (line.find(candidate) != std::string_view::npos) return candidate;
  return ' ';
}

/// Appends the columns' texts, at most `most` of them, separated by runs of blanks.
void split_at_blanks(std::string_view line, std::size_t most, std::vector<std::string_view>& fields) {
  for (line = trimmed(line); !line.empty() && fields.size() < most; line = trimmed(line)) {
    const auto end = std::find_if(line.begin(), line.end(), is_blank);
    fields.push_back(line.substr(0, static_cast<std::size_t>(end - line.begin())));
    line.remove_prefix(fields.back().size());
  }
}

/// Returns the text up to the next separator, without its quotes; a field in double quotes may contain separators.
std::string_view first_field(std::string_view line, char separator, std::size_t& end) {
  const std::size_t start = line.find_first_not_of(' ');
  const bool quoted = start != std::string_view::npos && line[start] == '"';
  const std::size_t closing = quoted ? line.find('"', start + 1) : std::string_view::npos;
  end = line.find(separator, closing == std::string_view::npos ? 0 : closing);
  const std::string_view field = trimmed(line.substr(0, end));
  if (field.size() < 2 || field.front() != '"' || field.back() != '"') return field;
  return trimmed(field.substr(1, field.size() - 2));
}

/// Splits a line into its first `most` fields.
void split(std::string_view line, char separator, std::size_t most, std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == ' ') return split_at_blanks(line, most, fields);
  for (std::size_t end = 0; end != std::string_view::npos && fields.size() < most;) {
    fields.push_back(first_field(line, separator, end));
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Whether a text looks like a number, even an invalid one such as one with a decimal comma: a line with it is no
/// header, but a bad row.
bool is_numeric(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos &&
         text.find_first_not_of("0123456789+-.,eE") == std::string_view::npos;
}

/// Quotes a text to fit in one line of a message.
std::string in_quotes(std::string_view text) {
  std::string shown(text.substr(0, 60));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return fmt::format("'{}{}'", shown, text.size() > 60 ? "..." : "");
}

std::optional<std::size_t> column_named(const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const auto& n) { return same_column_name(n, name); });
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Turns lines into points.
class RowParser {
 public:
  RowParser(const std::string& path, char separator, const std::array<std::size_t, 3>& columns)
      : path_(path),
        separator_(separator),
        columns_(columns),
        wanted_(*std::max_element(columns.begin(), columns.end()) + 1) {}

  /// Parses a row; the height is NaN where its field is empty.
  Point3 operator()(std::string_view line, std::uint64_t line_number) {
    split(line, separator_, wanted_, fields_);
    if (fields_.size() < wanted_)
      fail(line, line_number, fmt::format("{}, but {} are needed", counted(fields_.size(), "column"), wanted_));
    Point3 point;
    point.x = coordinate(0, line, line_number);
    point.y = coordinate(1, line, line_number);
    point.z =
        fields_[columns_[2]].empty() ? std::numeric_limits<double>::quiet_NaN() : coordinate(2, line, line_number);
    return point;
  }

 private:
  double coordinate(std::size_t axis, std::string_view line, std::uint64_t line_number) const {
    const std::string_view field = fields_[columns_[axis]];
    auto value = number_in(field);
    if (!value && separator_ != ',') value = number_in(with_decimal_point(std::string(field)));
    if (!value) fail(line, line_number, fmt::format("{} is not a number", in_quotes(field)));
    return *value;
  }

  [[noreturn]] void fail(std::string_view line, std::uint64_t line_number, const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {} in {}", path_, line_number, what, in_quotes(line)));
  }

  const std::string& path_;
  char separator_;
  std::array<std::size_t, 3> columns_;
  std::size_t wanted_;
  std::vector<std::string_view> fields_;
};

}  // namespace

DelimitedText::DelimitedText(std::string path, const std::string& z_field) : path_(std::move(path)) {
  LineReader lines(path_);
  std::error_code error;
  size_ = static_cast<double>(std::filesystem::file_size(path_, error));
  if (error) throw FileError(path_, "is not a plain file");
  bool understood = false;
  std::vector<Point2> places;
  while (places.size() < kFirstPlaces) {
    const auto line = lines.next();
    if (!line) break;
    if (is_skipped(*line)) continue;
    if (!understood) {
      understand(*line, z_field);
      understood = true;
      if (has_header_) continue;
    }
    const Point3 point = RowParser(path_, separator_, columns_)(*line, lines.line_number());
    places.push_back({point.x, point.y});
  }
  if (places.empty()) throw FileError(path_, "holds no points");
  centre_ = middle_place(std::move(places));
}

void DelimitedText::understand(std::string_view line, const std::string& z_field) {
  separator_ = separator_of(trimmed(line));
  std::vector<std::string_view> fields;
  split(line, separator_, std::numeric_limits<std::size_t>::max(), fields);
  has_header_ = std::none_of(fields.begin(), fields.end(), is_numeric);
  if (has_header_)
    choose_columns({fields.begin(), fields.end()}, z_field);
  else if (!z_field.empty())
    throw FileError(path_, fmt::format("has no header line to find the column '{}' in", z_field));
}

void DelimitedText::choose_columns(const std::vector<std::string>& names, const std::string& z_field) {
  if (const auto position = position_columns(names)) {
    columns_ = {position->x, position->y, 0};
    geographic_ = position->geographic;
    columns_[2] = height_column(names, z_field);
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

std::uint64_t DelimitedText::read(const Sink& sink) {
  LineReader lines(path_);
  RowParser parse(path_, separator_, columns_);
  PointBatch batch;
  const auto hand_on = [&] {
    sink(batch, std::min(1.0, static_cast<double>(lines.bytes_read()) / size_));
    batch.clear();
  };
  bool header_ahead = has_header_;
  while (const auto line = lines.next()) {
    if (is_skipped(*line)) continue;
    if (std::exchange(header_ahead, false)) continue;
    const Point3 point = parse(*line, lines.line_number());
    batch.add(point.x, point.y, point.z);
    if (batch.size() == kPointBatchSize) hand_on();
  }
  if (batch.size() > 0) hand_on();
  return 0;
}

}  // namespace itin
