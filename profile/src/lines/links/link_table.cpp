// Reads links from files.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/counted.hpp>
#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/file_ending.hpp>
#include <itin/height_limit.hpp>
#include <itin/paths.hpp>
#include <itin/position_columns.hpp>
#include <itin/text_table.hpp>
#include <itin/written_position.hpp>
#include <profile/links.hpp>
#include <profile/radio_text.hpp>

#include "lines/links/link_header.hpp"

namespace itin::profile {

namespace {

/// Whether a first row is a header: it is if no number stands where the coordinates are.
bool is_header(const std::vector<std::string>& cells) {
  return std::none_of(cells.begin() + 1, cells.end(),
                      [](const std::string& cell) { return number_in(cell).has_value(); });
}

/// Returns the cell with decimal points.
std::string with_points(std::string cell) {
  std::replace(cell.begin(), cell.end(), ',', '.');
  return cell;
}

/// Reads a frequency. In megahertz a comma may part thousands.
double frequency_in(const std::string& cell, bool megahertz) {
  const bool has_unit = std::any_of(cell.begin(), cell.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
  const std::string text = megahertz || has_unit ? with_decimal_point(cell) : with_points(cell);
  return parse_frequency_ghz(megahertz && !has_unit ? text + "MHz" : text);
}

std::vector<Criterion> criteria_in(const std::string& cell) {
  std::vector<Criterion> criteria;
  std::istringstream words(cell);
  for (std::string word; words >> word;) criteria.push_back(parse_criterion(word));
  return criteria;
}

void set(LinkExtra extra, const std::string& cell, Link& link) {
  switch (extra) {
    case LinkExtra::kName1:
      link.from_name = cell;
      break;
    case LinkExtra::kName2:
      link.to_name = cell;
      break;
    case LinkExtra::kFrequency:
    case LinkExtra::kMegahertz:
      link.frequency_ghz = frequency_in(cell, extra == LinkExtra::kMegahertz);
      break;
    case LinkExtra::kPolarisation:
      link.polarisation = parse_polarisation(cell);
      break;
    case LinkExtra::kCriteria:
      link.criteria = criteria_in(with_points(cell));
      break;
  }
}

class LinkReader {
 public:
  LinkReader(const std::string& path, const std::string& to_crs, const std::string& csv_crs, LinkTable& table)
      : path_(path), to_crs_(to_crs), csv_crs_(csv_crs), rows_(path), table_(table) {}

  void read() {
    for (std::size_t row = 0; rows_.next();) {
      const std::vector<std::string> cells(rows_.cells().begin(), rows_.cells().end());
      if (!std::exchange(understood_, true)) {
        const bool header = is_header(cells);
        understand(header ? cells : std::vector<std::string>());
        if (header) continue;
      }
      ++row;
      try {
        table_.links.push_back(link_of(cells, row));
      } catch (const InputError& error) {
        table_.bad.push_back(
            {row, fmt::format("line {}", rows_.line()), id_of(cells, row), error.what(), others_of(cells)});
      }
    }
    for (std::string& warning : rows_.warnings()) table_.warnings.push_back(std::move(warning));
  }

 private:
  static std::string cell(const std::vector<std::string>& cells, std::size_t i) {
    return i < cells.size() ? cells[i] : "";
  }

  std::string id_of(const std::vector<std::string>& cells, std::size_t row) const {
    return header_.numbered ? std::to_string(row) : cell(cells, header_.of[0]);
  }
  double number_of(const std::vector<std::string>& cells, std::size_t i) const {
    const std::string& text = cells[header_.of[i]];
    auto value = number_in(text);
    if (!value && header_.geographic && i % 3 != 0)
      value = i % 3 == 1 ? written_angle(text, 'E', 'W') : written_angle(text, 'N', 'S');
    if (!value && may_part_thousands(text))
      throw InputError(fmt::format("{} '{}' has a comma that may part thousands; write numbers with a decimal point",
                                   kLinkNames[i], text));
    if (!value || !std::isfinite(*value)) throw InputError(fmt::format("{} '{}' is no number", kLinkNames[i], text));
    return *value;
  }
  static std::optional<double> optional_number(const std::string& cell) {
    if (cell.empty()) return std::nullopt;
    const auto value = number_in(with_points(cell));
    if (!value) throw InputError(fmt::format("'{}' is no number", cell));
    return value;
  }
  double height_of(const std::vector<std::string>& cells, std::size_t i) const {
    const double height = number_of(cells, i);
    require_height(height, kLinkNames[i]);
    return height;
  }
  /// Reads the end whose x is in the column `i`, in the CRS asked for.
  Point2 position_of(const std::vector<std::string>& cells, std::size_t i) const {
    const auto transformed = [&](const Point2& p) { return transform_ ? (*transform_)(p) : p; };
    if (!header_.written) return transformed({number_of(cells, i), number_of(cells, i + 1)});
    const std::string& text = cells[header_.of[i]];
    const auto written = written_position(text);
    if (const auto xy = written ? std::nullopt : written_coordinates(text)) return transformed(*xy);
    if (!written) throw InputError(fmt::format("'{}' is {}", text, kNoWrittenPosition));
    return CoordinateTransform(written->crs, to_crs_)(written->position);
  }

  /// Learns the columns; `names` is empty where there is no header.
  void understand(const std::vector<std::string>& names) {
    header_ = link_header(names, path_);
    table_.warnings = header_.warnings;
    for (const std::size_t i : header_.others) table_.other_columns.push_back(names[i]);
    const std::string crs = csv_crs_.empty() && header_.geographic ? kGeographicColumnsCrs : csv_crs_;
    if (!crs.empty()) transform_.emplace(crs, to_crs_);
  }

  std::vector<std::string> others_of(const std::vector<std::string>& cells) const {
    std::vector<std::string> others;
    for (const std::size_t i : header_.others) others.push_back(cell(cells, i));
    return others;
  }

  void require_width(const std::vector<std::string>& cells) const {
    std::size_t width = cells.size();
    while (width > header_.width && cells[width - 1].empty()) --width;
    if (width != header_.width)
      throw InputError(
          fmt::format("has {} instead of {}: id,x1,y1,h1,x2,y2,h2", counted(width, "column"), header_.width));
  }

  Link link_of(const std::vector<std::string>& cells, std::size_t row) const {
    require_width(cells);
    Link link{id_of(cells, row), position_of(cells, 1), height_of(cells, 3), position_of(cells, 4),
              height_of(cells, 6)};
    for (const auto& [i, extra] : header_.extras) {
      if (cells[i].empty()) continue;
      try {
        set(extra, cells[i], link);
      } catch (const InputError& error) {
        throw InputError(fmt::format("'{}': {}", cells[i], error.what()));
      }
    }
    for (const auto& [i, value] : header_.budget) link.budget.*value = optional_number(cells[i]);
    link.others = others_of(cells);
    return link;
  }

  std::string path_, to_crs_, csv_crs_;
  TextTable rows_;
  LinkTable& table_;
  bool understood_ = false;  ///< whether the first row has been read
  std::optional<CoordinateTransform> transform_;
  LinkHeader header_;
};

/// A table is no layer, and its cells are not a database's.
void require_no_choice(const std::string& path, const LinkChoice& choice) {
  if (!choice.layer.empty())
    throw InputError(fmt::format("`layer` '{}': {} is a table, which has no layers; leave it out", choice.layer, path),
                     "layer");
  if (!choice.where.empty())
    throw InputError(
        fmt::format(
            "`where` {}: {} is a table, of which all rows are links; take out the others, or give a file of lines",
            choice.where, path),
        "where");
}

/// Warns of what links do not take from lines: places between the ends, and Z.
void warn_of_the_unused(const std::string& path, const std::vector<Path>& lines, std::vector<std::string>& warnings) {
  const auto warn = [&](const auto& has, const char* what) {
    const auto first = std::find_if(lines.begin(), lines.end(), has);
    if (first == lines.end()) return;
    const auto count = static_cast<std::uint64_t>(std::count_if(first, lines.end(), has));
    warnings.push_back(fmt::format("{}: {} ({} of {}, the first of them feature {})", path, what, count,
                                   counted(lines.size(), "line"), first->feature));
  };
  warn([](const Path& line) { return line.corners.size() > 2; },
       "links are straight from end to end; bends of lines are not followed");
  warn([](const Path& line) { return line.has_z; },
       "the Z of lines is not used; heights of antennas are above the ground");
}

LinkTable read_lines(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                     const std::string& crs, const LinkChoice& choice) {
  LinkTable table;
  const PathFile file = read_path_file(path, to_crs, {choice.layer, choice.where, crs});
  for (const Path& line : file.paths)
    table.links.push_back({line.id, line.corners.front(), heights.from_m, line.corners.back(), heights.to_m});
  table.warnings = file.warnings;
  warn_of_the_unused(path, file.paths, table.warnings);
  for (const BadPath& bad : file.bad)
    table.bad.push_back({bad.row, fmt::format("feature {}", bad.feature), bad.id, bad.message});
  return table;
}

}  // namespace

LinkTable read_link_table(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                          const std::string& csv_crs, const LinkChoice& choice) {
  LinkTable table;
  const std::string ending = ending_of(path);
  if (ending == ".csv" || ending == ".tsv" || ending == ".txt") {
    require_no_choice(path, choice);
    LinkReader(path, to_crs, csv_crs, table).read();
  } else {
    table = read_lines(path, to_crs, heights, csv_crs, choice);
  }
  table.path = path;
  if (table.links.empty() && table.bad.empty())
    throw InputError(fmt::format("{}: holds no link; give rows id,x1,y1,h1,x2,y2,h2, or lines", path));
  return table;
}

}  // namespace itin::profile
