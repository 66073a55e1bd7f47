// Reads points in delimited text: CSV, XYZ, TXT. There is one point per row of a TextTable, whose cells blanks may
// separate, too.
//
//   DelimitedText text("survey.csv", "height_od");
//   text.read([](PointBatch& points, double fraction) { ... });
//
// A first row without anything like a number is a header, and the columns are found by name: the position's as
// position_columns() tells, and the height's by its usual names (z, height, elevation, ...). Otherwise the first three
// columns are x, y and height. Numbers are those of number_in(); an empty height is a void.
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
  /// Reads the first rows. `z_field` names the height column; if it is empty, the column is found by its usual
  /// names, or is the third. Throws FileError (not readable, no such column, no points), InputError (a malformed row).
  DelimitedText(std::string path, const std::string& z_field);

  const std::string& path() const override { return path_; }
  /// Returns EPSG:4326 where the columns are called longitude and latitude.
  std::string crs() const override { return geographic_ ? kGeographicColumnsCrs : ""; }
  std::vector<std::string> warnings() const override { return warnings_; }
  /// A position amid the first points.
  Point2 centre() const override { return centre_; }
  double size_hint() const override { return size_; }
  /// Tells of another column of heights where those that were read are 0 throughout.
  std::string warning() const override;
  /// Reads the points. Throws InputError naming file, line and text of the first malformed row.
  std::uint64_t read(const Sink& sink) override;

 private:
  void understand(const std::vector<std::string>& first, const std::string& z_field);
  void choose_columns(const std::vector<std::string>& names, const std::string& z_field);
  std::size_t height_column(const std::vector<std::string>& names, const std::string& z_field) const;

  void find_other_height(const std::vector<std::string>& names);

  std::string path_;
  double size_ = 0;  ///< bytes
  std::array<std::size_t, 3> columns_{0, 1, 2};
  bool has_header_ = false;
  bool geographic_ = false;
  std::string other_height_;  ///< a column that is called as heights are; empty: none, or the height was named
  bool level_ = false;        ///< heights were 0 throughout
  Point2 centre_;
  std::vector<std::string> warnings_;
};

}  // namespace itin
