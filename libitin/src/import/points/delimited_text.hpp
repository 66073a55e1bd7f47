// Points in delimited text: CSV, XYZ, TXT. One point per line; columns parted by semicolons, tabs, commas or blanks,
// found from the first line. Blank lines and lines that begin with # are skipped.
//
//   DelimitedText text("survey.csv", "height_od");
//   text.read([](PointBatch& points, double fraction) { ... });
//
// A first line without anything like a number is a header, and the columns are taken by name: those of the position as
// position_columns() has it, that of the height likewise (z, height, elevation, ...). Otherwise the first three columns
// are x, y and height. Numbers are decimal with a point, whatever the locale, or with a comma where commas do not part
// columns; an empty height is a void.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <itin/position_columns.hpp>

#include "import/source/point_reader.hpp"

namespace itin {

class DelimitedText final : public PointReader {
 public:
  /// Reads as far as the first point. `z_field` names the height column; empty: by its usual names, else the third.
  /// Throws FileError (not readable, no such column, no points), InputError (a malformed row).
  DelimitedText(std::string path, const std::string& z_field);

  const std::string& path() const override { return path_; }
  /// EPSG:4326 where the columns are called longitude and latitude.
  std::string crs() const override { return geographic_ ? kGeographicColumnsCrs : ""; }
  std::vector<std::string> warnings() const override { return warnings_; }
  /// The first point's position.
  Point2 centre() const override { return first_; }
  double size_hint() const override { return size_; }
  /// Throws InputError naming file, line and text of the first malformed row.
  std::uint64_t read(const Sink& sink) override;

 private:
  void understand(std::string_view line, const std::string& z_field);
  void choose_columns(const std::vector<std::string>& names, const std::string& z_field);
  std::size_t height_column(const std::vector<std::string>& names, const std::string& z_field) const;

  std::string path_;
  double size_ = 0;  ///< bytes
  char separator_ = ' ';
  std::array<std::size_t, 3> columns_{0, 1, 2};
  bool has_header_ = false;
  bool geographic_ = false;
  Point2 first_;
  std::vector<std::string> warnings_;
};

}  // namespace itin
