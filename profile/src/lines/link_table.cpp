// Links from files.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/paths.hpp>
#include <itin/position_columns.hpp>
#include <profile/links.hpp>

namespace itin::profile {

namespace {

constexpr std::size_t kLinkColumns = 7;
constexpr std::array<const char*, kLinkColumns> kLinkNames = {"id", "x1", "y1", "h1", "x2", "y2", "h2"};
constexpr const char* kUtf8Mark = "\xEF\xBB\xBF";

/// The cells of a row of CSV, without their quotes.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += c;
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::optional<double> cell_number(const std::string& text) {
  const std::string digits = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The columns of a link table.
struct Columns {
  std::array<std::size_t, kLinkColumns> of{0, 1, 2, 3, 4, 5, 6};  ///< the cell that each of kLinkNames is in
  bool geographic = false;                                        ///< positions are longitude and latitude
};

std::optional<std::size_t> column_of(const std::vector<std::string>& names, const char* name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [&](const std::string& n) { return same_column_name(n, name); });
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

/// By name where a header has all of them, x1 and y1 or what position_columns() has in place of them; else the columns
/// are in the usual order.
Columns columns_of(std::vector<std::string> names, const std::string& path) {
  for (std::string& name : names) name = trimmed(name);
  const auto from = position_columns(names, "1"), to = position_columns(names, "2");
  Columns columns;
  columns.geographic = from && from->geographic;
  if (columns.geographic != (to && to->geographic))
    throw InputError(path + ": its header names longitude and latitude for one end only; give both ends alike");
  const auto id = column_of(names, "id"), h1 = column_of(names, "h1"), h2 = column_of(names, "h2");
  if (from && to && id && h1 && h2) columns.of = {*id, from->x, from->y, *h1, to->x, to->y, *h2};
  return columns;
}

/// A first line with no number where the coordinates are is a header.
bool is_header(const std::vector<std::string>& cells) {
  return std::none_of(cells.begin() + 1, cells.end(),
                      [](const std::string& cell) { return cell_number(cell).has_value(); });
}

class TableReader {
 public:
  TableReader(const std::string& path, const std::string& to_crs, const std::string& csv_crs)
      : path_(path), to_crs_(to_crs), csv_crs_(csv_crs), file_(path) {
    if (!file_) throw FileError(path, "cannot be opened");
  }

  /// Calls take(link) or refuse(row, number of its line, id, what is wrong) for each row.
  template <class Take, class Refuse>
  void read(const Take& take, const Refuse& refuse) {
    std::string line;
    std::size_t row = 0;
    for (std::size_t number = 1; std::getline(file_, line); ++number) {
      if (number == 1 && line.starts_with(kUtf8Mark)) line.erase(0, 3);
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      const std::vector<std::string> cells = cells_of(line);
      if (number == 1) {
        const bool header = is_header(cells);
        understand(header ? cells : std::vector<std::string>());
        if (header) continue;
      }
      ++row;
      try {
        take(link_of(cells));
      } catch (const InputError& error) {
        refuse(row, number, columns_.of[0] < cells.size() ? cells[columns_.of[0]] : "", error.what());
      }
    }
  }

 private:
  /// `header` is empty where there is none.
  void understand(const std::vector<std::string>& header) {
    columns_ = columns_of(header, path_);
    width_ = std::max(header.size(), kLinkColumns);
    const std::string crs = csv_crs_.empty() && columns_.geographic ? kGeographicColumnsCrs : csv_crs_;
    if (!crs.empty()) transform_.emplace(crs, to_crs_);
  }

  Link link_of(const std::vector<std::string>& cells) const {
    if (cells.size() != width_)
      throw InputError(fmt::format("has {} columns instead of {}: id,x1,y1,h1,x2,y2,h2", cells.size(), width_));
    std::array<double, kLinkColumns> v{};
    for (std::size_t i = 1; i < kLinkColumns; ++i) {
      const auto value = cell_number(cells[columns_.of[i]]);
      if (!value) throw InputError(fmt::format("{} '{}' is no number", kLinkNames[i], cells[columns_.of[i]]));
      v[i] = *value;
    }
    for (const std::size_t h : {std::size_t{3}, std::size_t{6}}) require_height(v[h], kLinkNames[h]);
    Link link{cells[columns_.of[0]], {v[1], v[2]}, v[3], {v[4], v[5]}, v[6]};
    if (transform_) link.from = (*transform_)(link.from), link.to = (*transform_)(link.to);
    return link;
  }

  std::string path_, to_crs_, csv_crs_;
  std::ifstream file_;
  std::optional<CoordinateTransform> transform_;
  Columns columns_;
  std::size_t width_ = kLinkColumns;
};

bool is_table(const std::string& path) {
  return path.size() > 4 && path.ends_with(".csv");
}

std::vector<Link> read_lines(const std::string& path, const std::string& to_crs, const LinkHeights& heights) {
  std::vector<Link> links;
  for (const Path& line : read_paths(path, to_crs))
    links.push_back({line.name, line.corners.front(), heights.from_m, line.corners.back(), heights.to_m});
  return links;
}

}  // namespace

LinkTable read_link_table(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                          const std::string& csv_crs) {
  LinkTable table;
  if (is_table(path)) {
    TableReader(path, to_crs, csv_crs)
        .read([&](Link link) { table.links.push_back(std::move(link)); },
              [&](std::size_t row, std::size_t line, const std::string& id, const std::string& message) {
                table.bad.push_back({row, line, id, message});
              });
  } else {
    table.links = read_lines(path, to_crs, heights);
  }
  if (table.links.empty() && table.bad.empty())
    throw InputError(fmt::format("{}: holds no link; give rows id,x1,y1,h1,x2,y2,h2, or lines", path));
  return table;
}

}  // namespace itin::profile
