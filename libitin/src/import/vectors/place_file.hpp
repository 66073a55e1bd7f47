// A file of places: points in any vector format GDAL reads, or a text table with columns of positions.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/coordinates.hpp>
#include <itin/geometry.hpp>
#include <itin/plain_text.hpp>
#include <itin/sites.hpp>

namespace itin {

/// The layer of places that a query is about. To be used within the life of a QuietGdal.
class PlaceFile {
 public:
  /// Opens the layer, without its condition. Throws FileError, InputError (a table that is not understood).
  explicit PlaceFile(const SiteQuery& query);

  OGRLayer& layer() { return *layer_; }
  /// Returns the index of a field: of this name, or of one that same_column_name() says is the same, or of its first
  /// ten letters, which are what a Shapefile keeps. Negative where there is none.
  int field(const std::string& name) const;
  /// Returns the text of a feature's field as the file has it, made plain; empty where there is none.
  std::string text(const OGRFeature& feature, int field);
  /// Returns the number in a feature's field; nothing where it is empty, and not a number where it holds something
  /// else.
  std::optional<double> number(const OGRFeature& feature, int field);
  /// Tells where a feature stands: "feature 3", and the line where that is not the one to expect.
  std::string place_of(const OGRFeature& feature) const;
  /// Tells what is wrong with a feature's row; empty where nothing is.
  std::string wrong_row(const OGRFeature& feature) const;
  /// Whether the layer is a table, in which positions are cells.
  bool is_table() const { return layer_->GetGeomType() == wkbNone; }
  /// Tells of the texts that were not plain, and of lines that may be rows: known after reading.
  std::vector<std::string> warnings() const;

 private:
  struct Row {
    std::uint64_t line = 0;
    std::vector<std::string> cells;
  };
  void read_table(const std::string& path);
  const Row* row_of(const OGRFeature& feature) const;

  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
  std::vector<Row> rows_;  ///< the rows of a text table, whose features are numbered from 1
  std::uint64_t header_line_ = 0;
  PlainTexts texts_;
  std::vector<std::string> table_warnings_;
};

/// Finds where the features of such a layer lie, in the CRS asked for.
class Places {
 public:
  /// `file` must outlive it. Places are read in the CRS that crs_of_layer() tells, with query.crs as the one given.
  /// Failing both, a table headed longitude and latitude is in kGeographicColumnsCrs, and anything else in the wanted
  /// CRS. Throws InputError for a CRS that is unknown.
  Places(PlaceFile& file, const SiteQuery& query, const std::string& to_crs);

  struct Found {
    std::vector<Point2> positions;  ///< several for a multipoint
    std::string wrong;              ///< what is wrong with the place; then there are no positions
  };
  Found find(const OGRFeature& feature);
  /// Tells of a CRS that is not used, and of heights that points have and nobody uses; known after reading.
  std::vector<std::string> warnings() const;

 private:
  std::vector<Point2> positions_of(const OGRFeature& feature);
  std::vector<Point2> points_of(const OGRGeometry& geometry, const OGRFeature& feature);
  Point2 of_columns(const OGRFeature& feature);
  Point2 of_written(const std::string& text);
  double coordinate(const OGRFeature& feature, int field, const char* letters);
  Point2 in_wanted_crs(Point2 place) const { return transform_ ? (*transform_)(place) : place; }

  PlaceFile& file_;
  std::string path_, to_crs_, crs_warning_;
  bool geographic_ = false;
  std::vector<int> columns_;  ///< the fields of x and y, or the one of written positions, of a table
  int wkt_ = -1;              ///< the field of well-known text, of a table without such columns
  std::optional<CoordinateTransform> transform_;
  std::map<std::string, CoordinateTransform> of_written_;  ///< by the CRS that a written position states
  std::string unused_height_;                              ///< the first feature with Z, and its Z
};

}  // namespace itin
