// Reads lines in any vector format GDAL reads, in the importer's two steps: the file is opened to learn the CRS, then
// read into the store's grid.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <itin/import.hpp>

#include "import/source/layers/source_layer.hpp"
#include "import/source/source_context.hpp"

namespace itin {

class LineLayer final : public OpenedFile {
 public:
  struct Sink {
    /// A polyline on the grid, at least two positions.
    std::function<void(std::span<const GridPoint>)> line;
    /// The feature that the next lines belong to.
    std::function<void(FeatureRecord)> feature;
  };

  /// Opens the lines and polygons, multi-geometries, collections and curves of options.layer; a polygon gives its
  /// rings. Heights come from the field options.z_field, otherwise from Z; lines of kinds that lie on the surface need
  /// none. Throws FileError, InputError.
  LineLayer(const std::string& path, const ImportOptions& options);

  const std::string& path() const override { return layer_.path(); }
  Crs crs() const override { return crs_; }
  Point2 centre() const override { return centre_; }
  std::vector<std::string> warnings() const override { return warnings_; }

  /// The fields that are kept of the features.
  const FeatureFields& fields() const { return fields_; }

  /// Hands on every line and, before the lines of a feature, what is kept of the feature, if anything is. Lines without
  /// length on the grid, and lines with a vertex that has no height or no position, are left out with a warning; such
  /// vertices count as voids. Throws FileError, InputError, Cancelled, and what the sink throws.
  ReadCounts read(const SourceContext& context, const Sink& sink, Progress& progress);

  /// The source's information, complete after read().
  const SourceInfo& info() const { return info_; }
  /// The number of features with at least one line.
  std::uint64_t features() const { return features_; }

 private:
  struct Line {
    std::vector<double> x, y, z;
  };
  void collect(const OGRGeometry& geometry, const OGRFeature& feature, std::vector<Line>& lines) const;
  void add(const OGRSimpleCurve& curve, const OGRFeature& feature, std::vector<Line>& lines) const;
  std::vector<Line> lines_of(const OGRFeature& feature) const;
  void find_centre();
  void describe(const ReadCounts& counts, const Grid& grid, Progress& progress);

  SourceLayer layer_;
  FeatureFields fields_;
  ThemeKind kind_;
  double max_gap_;
  Crs crs_;
  SourceHeights heights_;
  Point2 centre_;
  std::vector<std::string> warnings_;
  SourceInfo info_;
  std::uint64_t features_ = 0;
};

}  // namespace itin
