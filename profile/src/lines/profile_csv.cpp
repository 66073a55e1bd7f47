#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/height_limit.hpp>
#include <profile/profile.hpp>

#include "lines/delimited.hpp"

namespace itin::profile {

namespace {

constexpr std::string_view kProfileColumns[] = {"d_km", "h_m", "clutter_m"};

class Reader {
 public:
  explicit Reader(const std::string& name) : name_(name) {}

  void read(std::string line) {
    ++line_;
    if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') return;
    if (columns_ == 0) separator_ = separator_of(line);
    const std::vector<std::string> fields = cells_of(line, separator_);
    if (columns_ == 0 && !number_in(fields.front(), separator_)) return read_header(fields);
    if (columns_ == 0) set_columns(fields.size());
    read_row(fields);
  }

  Profile finish() {
    if (profile_.points.size() < 2) {
      throw InputError(fmt::format("{}: holds {} row{}; a profile takes at least 2: its ends", name_,
                                   profile_.points.size(), profile_.points.size() == 1 ? "" : "s"));
    }
    const double start = profile_.points.front().distance_m;
    for (ProfilePoint& p : profile_.points) p.distance_m -= start;
    profile_.length_m = profile_.points.back().distance_m;
    if (profile_.length_m <= 0) fail("the profile has no length; its distances are all the same");
    return std::move(profile_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}, line {}: {}", name_, line_, what));
  }
  void set_columns(std::size_t count) {
    if (count < 2 || count > 3)
      fail(fmt::format("{}; expected d_km,h_m or d_km,h_m,clutter_m", counted(count, "column")));
    columns_ = count;
  }
  void read_header(const std::vector<std::string>& names) {
    set_columns(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string lower = names[i];
      std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
      if (lower != kProfileColumns[i]) fail(fmt::format("column '{}'; expected d_km,h_m[,clutter_m]", names[i]));
    }
  }
  double value(const std::vector<std::string>& fields, std::size_t column) const {
    const std::string& text = fields[column];
    const auto parsed = number_in(text, separator_);
    if (!parsed) fail(fmt::format("{} '{}' is not a number", kProfileColumns[column], text));
    if (!std::isfinite(*parsed)) fail(fmt::format("{} '{}' is not a finite number", kProfileColumns[column], text));
    if (column == 1 && is_usual_nodata(*parsed))
      fail(
          fmt::format("{} '{}' stands for missing data, which a profile must not have", kProfileColumns[column], text));
    return *parsed;
  }
  void read_row(const std::vector<std::string>& fields) {
    if (fields.size() != columns_) fail(fmt::format("{} columns where {} were expected", fields.size(), columns_));
    ProfilePoint point;
    point.distance_m = value(fields, 0) * 1000;
    point.ground_m = value(fields, 1);
    if (columns_ == 3) point.clutter_m = value(fields, 2);
    if (point.clutter_m < 0) fail("clutter_m is negative");
    for (const double height : {point.ground_m, point.clutter_m})
      require_height(height, fmt::format("{}, line {}", name_, line_));
    if (!profile_.points.empty() && point.distance_m < profile_.points.back().distance_m) {
      fail(fmt::format("d_km {} is less than in the row before; distances must ascend", fields[0]));
    }
    profile_.points.push_back(point);
  }

  const std::string& name_;
  std::size_t line_ = 0, columns_ = 0;
  char separator_ = ',';
  Profile profile_;
};

}  // namespace

Profile read_profile_csv(std::istream& text, const std::string& name) {
  Reader reader(name);
  for (std::string line; std::getline(text, line);) reader.read(std::move(line));
  return reader.finish();
}

Profile read_profile_csv(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) throw FileError(path, "cannot be read; check the name");
  return read_profile_csv(file, path);
}

}  // namespace itin::profile
