// Lists of sites, observers, candidates or turbines: named points with an optional height, from any vector file.
//
//   SiteQuery query;
//   query.path = "masts.gpkg";
//   query.height_field = "mast_m";
//   for (const Site& site : read_sites(query, store.metadata().crs_wkt, warnings)) ...
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

namespace itin {

/// A further field to read as numbers.
struct NumberField {
  std::string name;
  bool required = true;  ///< an error if the layer has no such field; otherwise no site has a value
};

struct SiteQuery {
  std::string path;          ///< a text table with columns of x and y, or whatever vector format GDAL reads
  std::string layer;         ///< default: the file's only layer
  std::string where;         ///< an attribute filter in OGR's SQL; default: all features
  std::string height_field;  ///< metres; default: no heights
  std::string name_field;    ///< default: the feature's number
  std::vector<NumberField> numbers;
  std::vector<std::string> texts = {};  ///< further fields to read as text; of one that the layer lacks, all are empty
  /// The CRS of a file that names none, one that is not defined, or degrees that its coordinates cannot be; it
  /// overrides no other. Default: longitude and latitude where the columns of a CSV file are called so
  /// (position_columns.hpp), else the CRS asked for.
  std::string crs;
};

struct Site {
  std::int64_t feature = 0;        ///< the file's own number for the feature
  std::int64_t row = 0;            ///< the feature's place among the features asked for, from 0
  std::string place;               ///< where it stands in the file: "feature 3", or "feature 3, line 9" of a table
  std::string name;                ///< with a number behind it for each of several points of one feature
  Point2 position;                 ///< in the CRS asked for
  std::optional<double> height;    ///< nothing where the field is empty, or none is asked for
  std::vector<std::string> texts;  ///< one for each SiteQuery::texts
  std::vector<std::optional<double>> numbers;  ///< one for each SiteQuery::numbers; nothing where the field is empty
};

/// The fields of the layer that a query is about, read once.
class LayerFields {
 public:
  /// Throws FileError for a file or layer that is missing or not understood.
  explicit LayerFields(const SiteQuery& query);
  /// Returns the name of the field that same_column_name() says is the same: `name` itself, but for the case of its
  /// letters, or else what the layer calls it.
  std::optional<std::string> named(const std::string& name) const;
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// Returns all sites in the file's order, in the CRS `to_crs` (WKT). `warnings` gets a line for each kind of thing that
/// was read otherwise than it is written, or not at all. Throws FileError for a file, layer, field, filter or feature
/// that is missing or not understood (naming it), InputError for a CRS that is unknown, a height beyond
/// kFarthestHeight, and a filter that leaves nothing.
std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>& warnings);

/// Does the same, but leaves out features that are not understood, each with a line in `rejected` that names it.
std::vector<Site> read_sites(const SiteQuery& query, const std::string& to_crs, std::vector<std::string>& warnings,
                             std::vector<std::string>& rejected);

}  // namespace itin
