// An import has two steps. A source is opened to learn its CRS and centre. Once the first source has determined the
// store's CRS and grid, each source is bound to them and becomes a TerrainSource.
//
//   std::unique_ptr<SourceFile> open_raster_source(const std::string& path, const ImportOptions&);
//   std::unique_ptr<SourceFile> open_point_source(const std::string& path, const ImportOptions&);
//   std::unique_ptr<SourceFile> open_las_source(const std::string& path, const ImportOptions&);
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <itin/file_digest.hpp>
#include <itin/geometry.hpp>
#include <itin/height_limit.hpp>

#include "gdal/crs.hpp"
#include "import/source/source_heights.hpp"
#include "import/source/terrain_source.hpp"
#include "import/source/true_cells.hpp"

namespace itin {

/// The part of the store that a source needs to know.
struct SourceContext {
  Grid grid;
  std::string crs_wkt;
  /// The scale of that CRS; null for sources that are known to lie where it is true.
  const ScaleMeter* scale = nullptr;
};

/// A file that was opened and understood. The constructor's work is bounded: headers, not points.
class OpenedFile {
 public:
  virtual ~OpenedFile() = default;
  virtual const std::string& path() const = 0;
  /// The CRS of --crs, else the one found in the file. Throws InputError where there is neither.
  virtual Crs crs() const = 0;
  /// A position amid the file's points, in its own CRS.
  virtual Point2 centre() const = 0;
  /// The box of the file's points in its own CRS, so far as it is known without reading them: at least the centre.
  virtual Box extent() const { return {centre().x, centre().y, centre().x, centre().y}; }
  /// Assumptions made on opening, one line each.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// An opened file of terrain points. Its answers hold only before bind().
class SourceFile : public OpenedFile {
 public:
  /// Binds the file to a store; to be called once. Throws InputError where coordinates cannot be transformed.
  virtual std::unique_ptr<TerrainSource> bind(const SourceContext& context) = 0;
};

/// Where the elevations of a source come from.
enum class Elevations {
  in_coordinates,
  in_field,  ///< the ellipsoid does not count unless --crs says so: GDAL infers it from coordinates with a Z (GeoJSON)
  none       ///< the source has none, or its heights are above the ground; no datum counts
};

/// The CRS of a source: the one of --crs, in which a missing horizontal or vertical part is taken from `found`, the
/// text that the file holds. It has no datum of heights that does not count. Throws InputError that says
/// `--crs EPSG:xxxx` where neither has a horizontal part.
Crs source_crs(const std::string& path, const std::string& option_crs, const std::string& found, Elevations elevations);

/// Whether a number customarily stands for a missing height, and surely is no height.
bool is_missing_mark(double height);

/// The warning about `count` heights that were taken as missing, `mark` among them.
std::string warning_of_marks(const std::string& path, std::uint64_t count, double mark);

/// Takes points from a source's coordinates to the grid, a batch at a time; the last step of every kind of source.
class Placement {
 public:
  enum class Missing {
    kNotDeclared,  ///< a value for which is_usual_nodata() holds is a void
    kDeclared,     ///< the source's declared nodata is NaN by now, and nothing else is missing
  };
  Placement(std::string path, const Crs& crs, const HeightAxis& heights, const SourceContext& context, Missing missing);

  /// Transforms x and y in place, and replaces `points` by those that have a position and a height. Points whose height
  /// is NaN, is_missing_mark(), missing, below -12,000 m or above 20,000 m, or whose position has no image are counted
  /// as voids. Positions that the grid cannot hold, or where lengths in the store's CRS are not true, are left out.
  /// Throws InputError for a height beyond kFarthestHeight.
  void place(std::span<double> x, std::span<double> y, std::span<const double> z, std::vector<GridPoint>& points);
  /// Transforms positions only, such as the corners of a lattice step. A position without image becomes NaN.
  void transform(std::span<double> x, std::span<double> y) const { transform_.transform(x, y); }

  /// Counts what has been placed so far, with warning lines for heights and positions that were refused. Where lengths
  /// are not true at more than a tenth of the points, the bounds include all of them. Throws InputError where the grid
  /// could hold none of the positions.
  ReadCounts counts() const;

 private:
  /// Points that are left out for where they lie.
  struct Far {
    std::uint64_t count = 0;
    Point2 first;
    Box box;
    void add(Point2 p) {
      if (count++ == 0) first = p;
      box.extend(p);
    }
  };
  std::string beyond_the_grid() const;
  GridBox bounds() const;
  void require_heights(std::span<const double> x, std::span<const double> y, std::span<const double> z) const;

  std::string path_;
  PointTransform transform_;
  double height_factor_;
  Grid grid_;
  GridBox bounds_;
  Missing missing_;
  std::uint64_t placed_ = 0, voids_ = 0, marks_ = 0, out_of_range_ = 0, unmapped_ = 0;
  std::optional<TrueCells> true_cells_;
  Far beyond_, astray_;  ///< beyond the grid, and where lengths are not true
  double mark_ = 0;      ///< one of the heights counted in marks_
};

/// Returns the time now, or the one that SOURCE_DATE_EPOCH gives (reproducible-builds.org), like
/// "2024-05-31T12:00:00Z". Throws InputError where SOURCE_DATE_EPOCH is no time.
std::string utc_now();

}  // namespace itin
