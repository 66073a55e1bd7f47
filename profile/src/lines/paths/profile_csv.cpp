#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/decimal_comma.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <itin/position_columns.hpp>
#include <itin/text_table.hpp>
#include <profile/profile.hpp>

namespace itin::profile {

namespace {

constexpr std::array<std::string_view, 3> kProfileColumns{"d_km", "h_m", "clutter_m"};

/// No line of sight on the Earth is as long.
constexpr double kLongestKm = 1000;

/// The unit of a profile's distances: stated by its header, or else kilometres, as is usual.
enum class DistanceUnit { kUsual, kKilometres, kMetres };

bool is_any(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view n) { return same_column_name(name, n); });
}

/// The unit that the name of the column of distances states; nothing for a name that is not understood.
std::optional<DistanceUnit> unit_of(std::string_view name) {
  if (is_any(name, {"d_km", "distance_km", "dist_km"})) return DistanceUnit::kKilometres;
  if (!is_any(name, {"d", "distance", "dist"})) return std::nullopt;
  return name.ends_with('m') || name.ends_with("m)") || name.ends_with("m]") ? DistanceUnit::kMetres
                                                                             : DistanceUnit::kUsual;
}

bool is_kind_letter(std::string_view cell) {
  return cell == "B" || cell == "T" || cell == "N";
}

class Reader {
 public:
  Reader(std::istream& text, const std::string& name) : name_(name), rows_(text, name) {}

  Profile read(std::vector<std::string>& warnings) {
    while (rows_.next()) {
      if (columns_ > 0 || !read_header()) read_row();
    }
    if (profile_.points.size() < 2)
      throw InputError(fmt::format("{}: holds {} row{}; a profile takes at least 2: its ends", name_,
                                   profile_.points.size(), profile_.points.size() == 1 ? "" : "s"));
    finish(warnings);
    for (std::string& warning : rows_.warnings()) warnings.push_back(std::move(warning));
    return std::move(profile_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", name_, rows_.line(), what));
  }

  /// Learns the columns from the first row; false where it is no header.
  bool read_header() {
    const auto& cells = rows_.cells();
    columns_ = cells.size();
    // A profile of profile_text() has the kind of what stands there in a fourth column.
    if (columns_ == 4 && is_kind_letter(cells[3])) return false;
    if (columns_ < 2 || columns_ > 3)
      fail(fmt::format("{}; expected d_km,h_m or d_km,h_m,clutter_m", counted(columns_, "column")));
    if (number_in(cells[0])) return false;
    const auto unit = unit_of(cells[0]);
    if (!unit) refuse_column(cells[0]);
    if (!is_any(cells[1], {"h_m", "height", "elevation", "ground", "z"})) refuse_column(cells[1]);
    if (columns_ == 3 && !is_any(cells[2], {"clutter_m", "obstacle"})) refuse_column(cells[2]);
    unit_ = *unit;
    return true;
  }
  [[noreturn]] void refuse_column(std::string_view name) const {
    fail(fmt::format("column '{}'; expected d_km,h_m[,clutter_m], or d_m for distances in metres", name));
  }

  double value(std::size_t column) const {
    const std::string_view text = rows_.cells()[column];
    const auto number = number_in(text);
    if (!number) fail(fmt::format("{} '{}' is not a number", kProfileColumns[column], text));
    if (!std::isfinite(*number)) fail(fmt::format("{} '{}' is not a finite number", kProfileColumns[column], text));
    if (column == 1 && is_usual_nodata(*number))
      fail(
          fmt::format("{} '{}' stands for missing data, which a profile must not have", kProfileColumns[column], text));
    return *number;
  }

  void read_row() {
    const std::size_t cells = rows_.cells().size();
    if (cells != columns_) fail(fmt::format("{} columns where {} were expected", cells, columns_));
    ProfilePoint point;
    point.distance_m = value(0) * (unit_ == DistanceUnit::kMetres ? 1 : 1000);
    point.ground_m = value(1);
    if (columns_ > 2) point.clutter_m = value(2);
    if (point.clutter_m < 0) fail("clutter_m is negative");
    for (const double height : {point.ground_m, point.clutter_m})
      require_height(height, fmt::format("{}, line {}", name_, rows_.line()));
    if (!profile_.points.empty() && point.distance_m < profile_.points.back().distance_m)
      fail(fmt::format("d_km {} is less than in the row before; distances must ascend", rows_.cells()[0]));
    profile_.points.push_back(point);
  }

  /// Lets the profile begin at 0, and looks at its length.
  void finish(std::vector<std::string>& warnings) {
    const double start = profile_.points.front().distance_m;
    for (ProfilePoint& p : profile_.points) p.distance_m -= start;
    const double length_km = profile_.points.back().distance_m / 1000;
    if (length_km <= 0) fail("the profile has no length; its distances are all the same");
    if (length_km > kLongestKm && unit_ != DistanceUnit::kUsual)
      throw InputError(
          fmt::format("{}: is {:.0f} km long, and no line of sight is; state the unit of its distances by a "
                      "header d_km,h_m or d_m,h_m",
                      name_, length_km));
    if (length_km > kLongestKm) {
      for (ProfilePoint& p : profile_.points) p.distance_m /= 1000;
      warnings.push_back(
          fmt::format("{}: its distances reach {:.0f} and are taken for metres, not kilometres; a header "
                      "d_m,h_m or d_km,h_m states the unit",
                      name_, length_km));
    }
    profile_.length_m = profile_.points.back().distance_m;
  }

  const std::string& name_;
  TextTable rows_;
  std::size_t columns_ = 0;
  DistanceUnit unit_ = DistanceUnit::kUsual;
  Profile profile_;
};

}  // namespace

Profile read_profile_csv(std::istream& text, const std::string& name, std::vector<std::string>& warnings) {
  return Reader(text, name).read(warnings);
}

Profile read_profile_csv(const std::string& path, std::vector<std::string>& warnings) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw FileError(path, "cannot be read; check the name");
  return read_profile_csv(file, path, warnings);
}

}  // namespace itin::profile
