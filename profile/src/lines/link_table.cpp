// Reads links from files.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/coordinates.hpp>
#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/height_limit.hpp>
#include <itin/paths.hpp>
#include <itin/position_columns.hpp>
#include <itin/written_position.hpp>
#include <profile/links.hpp>
#include <profile/radio_text.hpp>

#include "lines/delimited.hpp"

namespace itin::profile {

namespace {

constexpr std::size_t kLinkColumns = 7;
constexpr std::array<const char*, kLinkColumns> kLinkNames = {"id", "x1", "y1", "h1", "x2", "y2", "h2"};
constexpr const char* kUtf8Mark = "\xEF\xBB\xBF";

/// Columns that a header may have besides kLinkNames.
enum class Extra { kName1, kName2, kFrequency, kPolarisation, kCriteria };
struct ExtraName {
  const char* name;
  Extra extra;
};
constexpr ExtraName kExtraNames[] = {
    {"name1", Extra::kName1},         {"site1", Extra::kName1},
    {"name2", Extra::kName2},         {"site2", Extra::kName2},
    {"frequency", Extra::kFrequency}, {"frequency_ghz", Extra::kFrequency},
    {"pol", Extra::kPolarisation},    {"polarisation", Extra::kPolarisation},
    {"criteria", Extra::kCriteria},   {"polarization", Extra::kPolarisation},
    {"criterion", Extra::kCriteria},
};

/// The columns of a link table.
struct Columns {
  std::array<std::size_t, kLinkColumns> of{0, 1, 2, 3, 4, 5, 6};  ///< the cell that each of kLinkNames is in
  bool named = false;                                             ///< named by a header, else in the usual order
  bool numbered = false;    ///< no column is an id: links have the numbers of their rows
  bool geographic = false;  ///< positions are longitude and latitude
  bool written = false;     ///< whether x1 and y1 are one cell, as written_position() reads it
  std::vector<std::pair<std::size_t, Extra>> extras;
  std::vector<std::size_t> others;
};

std::optional<std::size_t> column_of(const std::vector<std::string>& names, const char* name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const std::string& n) { return same_column_name(n, name); });
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// Sorts the columns that hold no part of a link's ends.
void add_further(const std::vector<std::string>& names, Columns& columns) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(columns.of.begin(), columns.of.end(), i) != columns.of.end()) continue;
    const auto extra = std::find_if(std::begin(kExtraNames), std::end(kExtraNames),
                                    [&](const ExtraName& e) { return same_column_name(names[i], e.name); });
    if (extra != std::end(kExtraNames)) {
      columns.extras.emplace_back(i, extra->extra);
    } else {
      columns.others.push_back(i);
    }
  }
}

/// The column of an end's position written as people do.
std::optional<std::size_t> written_column(const std::vector<std::string>& names, const char* end) {
  for (const char* name : {"position", "gridref", "grid_ref", "ngr"})
    if (const auto found = column_of(names, (std::string(name) + end).c_str())) return found;
  return std::nullopt;
}

std::optional<std::size_t> id_column(const std::vector<std::string>& names) {
  for (const char* name : {"id", "name", "link"})
    if (const auto found = column_of(names, name)) return found;
  return std::nullopt;
}

/// Finds the columns by name where a header has any of them: x1 and y1, or what position_columns() or written_column()
/// accept in place of these. Otherwise the columns are in the usual order.
Columns columns_of(const std::vector<std::string>& names, const std::string& path) {
  const auto from = position_columns(names, "1"), to = position_columns(names, "2");
  Columns columns;
  columns.geographic = from && from->geographic;
  if (columns.geographic != (to && to->geographic))
    throw InputError(path + ": its header names longitude and latitude for one end only; give both ends alike");
  const auto h1 = column_of(names, "h1"), h2 = column_of(names, "h2");
  const auto position1 = written_column(names, "1"), position2 = written_column(names, "2");
  columns.written = !from && !to && position1 && position2;
  std::vector<const char*> missing;
  if (!from && !columns.written) missing.insert(missing.end(), {"x1", "y1"});
  if (!h1) missing.push_back("h1");
  if (!to && !columns.written) missing.insert(missing.end(), {"x2", "y2"});
  if (!h2) missing.push_back("h2");
  columns.named = from || to || position1 || position2 || h1 || h2;
  if (columns.named && !missing.empty())
    throw InputError(fmt::format("{}: its header has no column {}; name the columns id,x1,y1,h1,x2,y2,h2, in any order",
                                 path, fmt::join(missing, ", ")));
  const auto id = id_column(names);
  columns.numbered = columns.named && !id;
  const std::size_t first = id.value_or(h1.value_or(0));  // h1 a second time, so that no other column is taken
  if (columns.written) columns.of = {first, *position1, *position1, *h1, *position2, *position2, *h2};
  if (from && to) columns.of = {first, from->x, from->y, *h1, to->x, to->y, *h2};
  add_further(names, columns);
  return columns;
}

/// Whether a first line is a header: it is if no number stands where the coordinates are.
bool is_header(const std::vector<std::string>& cells, char separator) {
  return std::none_of(cells.begin() + 1, cells.end(),
                      [&](const std::string& cell) { return number_in(cell, separator).has_value(); });
}

std::vector<Criterion> criteria_in(const std::string& cell) {
  std::vector<Criterion> criteria;
  std::istringstream words(cell);
  for (std::string word; words >> word;) criteria.push_back(parse_criterion(word));
  return criteria;
}

/// Sets a value of the link; `numbers` is the cell with decimal points.
void set(Extra extra, const std::string& cell, const std::string& numbers, Link& link) {
  switch (extra) {
    case Extra::kName1:
      link.from_name = cell;
      break;
    case Extra::kName2:
      link.to_name = cell;
      break;
    case Extra::kFrequency:
      link.frequency_ghz = parse_frequency_ghz(numbers);
      break;
    case Extra::kPolarisation:
      link.polarisation = parse_polarisation(cell);
      break;
    case Extra::kCriteria:
      link.criteria = criteria_in(numbers);
      break;
  }
}

class TableReader {
 public:
  TableReader(const std::string& path, const std::string& to_crs, const std::string& csv_crs, LinkTable& table)
      : path_(path), to_crs_(to_crs), csv_crs_(csv_crs), file_(path), table_(table) {
    if (!file_) throw FileError(path, "cannot be opened");
  }

  void read() {
    std::string line;
    std::size_t row = 0;
    bool first = true;  // before a line that is not blank has been read
    for (std::size_t number = 1; std::getline(file_, line); ++number) {
      if (number == 1 && line.starts_with(kUtf8Mark)) line.erase(0, 3);
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (first) separator_ = separator_of(line);
      const std::vector<std::string> cells = cells_of(line, separator_);
      if (std::exchange(first, false)) {
        const bool header = is_header(cells, separator_);
        understand(header ? cells : std::vector<std::string>());
        if (header) continue;
      }
      ++row;
      try {
        table_.links.push_back(link_of(cells, row));
      } catch (const InputError& error) {
        table_.bad.push_back({row, fmt::format("line {}", number), id_of(cells, row), error.what(), others_of(cells)});
      }
    }
  }

 private:
  static std::string cell(const std::vector<std::string>& cells, std::size_t i) {
    return i < cells.size() ? cells[i] : "";
  }

  std::string id_of(const std::vector<std::string>& cells, std::size_t row) const {
    return columns_.numbered ? std::to_string(row) : cell(cells, columns_.of[0]);
  }
  double number_of(const std::vector<std::string>& cells, std::size_t i) const {
    const std::string& text = cells[columns_.of[i]];
    auto value = number_in(text, separator_);
    if (!value && columns_.geographic)
      value = i % 3 == 1 ? written_angle(with_points(text), 'E', 'W') : written_angle(with_points(text), 'N', 'S');
    if (!value || !std::isfinite(*value)) throw InputError(fmt::format("{} '{}' is no number", kLinkNames[i], text));
    return *value;
  }
  double height_of(const std::vector<std::string>& cells, std::size_t i) const {
    const double height = number_of(cells, i);
    require_height(height, kLinkNames[i]);
    return height;
  }
  /// Reads the end whose x is in the column `i`, in the CRS asked for.
  Point2 position_of(const std::vector<std::string>& cells, std::size_t i) const {
    if (!columns_.written) {
      const Point2 p{number_of(cells, i), number_of(cells, i + 1)};
      return transform_ ? (*transform_)(p) : p;
    }
    const std::string& text = cells[columns_.of[i]];
    const auto written = written_position(with_points(text));
    if (!written)
      throw InputError(
          fmt::format("'{}' is no grid reference, and no latitude and longitude with their letters", text));
    return CoordinateTransform(written->crs, to_crs_)(written->position);
  }

  /// Returns the cell with decimal points, for frequencies and criteria are numbers, too.
  std::string with_points(std::string cell) const {
    if (separator_ != ',') std::replace(cell.begin(), cell.end(), ',', '.');
    return cell;
  }

  /// Learns the columns; `header` is empty where there is none.
  void understand(const std::vector<std::string>& header) {
    columns_ = columns_of(header, path_);
    width_ = columns_.named ? header.size() : std::max(header.size(), kLinkColumns);
    for (const std::size_t i : columns_.others) table_.other_columns.push_back(header[i]);
    const std::string crs = csv_crs_.empty() && columns_.geographic ? kGeographicColumnsCrs : csv_crs_;
    if (!crs.empty()) transform_.emplace(crs, to_crs_);
  }

  std::vector<std::string> others_of(const std::vector<std::string>& cells) const {
    std::vector<std::string> others;
    for (const std::size_t i : columns_.others) others.push_back(cell(cells, i));
    return others;
  }

  Link link_of(const std::vector<std::string>& cells, std::size_t row) const {
    if (cells.size() != width_)
      throw InputError(
          fmt::format("has {} instead of {}: id,x1,y1,h1,x2,y2,h2", counted(cells.size(), "column"), width_));
    Link link{id_of(cells, row), position_of(cells, 1), height_of(cells, 3), position_of(cells, 4),
              height_of(cells, 6)};
    for (const auto& [i, extra] : columns_.extras) {
      if (cells[i].empty()) continue;
      try {
        set(extra, cells[i], with_points(cells[i]), link);
      } catch (const InputError& error) {
        throw InputError(fmt::format("'{}': {}", cells[i], error.what()));
      }
    }
    link.others = others_of(cells);
    return link;
  }

  std::string path_, to_crs_, csv_crs_;
  std::ifstream file_;
  LinkTable& table_;
  char separator_ = ',';
  std::optional<CoordinateTransform> transform_;
  Columns columns_;
  std::size_t width_ = kLinkColumns;
};

/// A table is no layer, and its cells are not a database's.
void require_no_choice(const std::string& path, const LinkChoice& choice) {
  if (!choice.layer.empty())
    throw InputError(fmt::format("`layer` '{}': {} is a table, which has no layers; leave it out", choice.layer, path));
  if (!choice.where.empty())
    throw InputError(fmt::format(
        "`where` {}: {} is a table, of which all rows are links; take out the others, or give a file of lines",
        choice.where, path));
}

LinkTable read_lines(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                     const LinkChoice& choice) {
  LinkTable table;
  const PathFile file = read_path_file(path, to_crs, {choice.layer, choice.where});
  for (const Path& line : file.paths)
    table.links.push_back({line.id, line.corners.front(), heights.from_m, line.corners.back(), heights.to_m});
  for (const BadPath& bad : file.bad)
    table.bad.push_back({bad.row, fmt::format("feature {}", bad.feature), bad.id, bad.message});
  return table;
}

}  // namespace

LinkTable read_link_table(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                          const std::string& csv_crs, const LinkChoice& choice) {
  LinkTable table;
  if (ending_of(path) == ".csv") {
    require_no_choice(path, choice);
    TableReader(path, to_crs, csv_crs, table).read();
  } else {
    table = read_lines(path, to_crs, heights, choice);
  }
  if (table.links.empty() && table.bad.empty())
    throw InputError(fmt::format("{}: holds no link; give rows id,x1,y1,h1,x2,y2,h2, or lines", path));
  return table;
}

}  // namespace itin::profile
