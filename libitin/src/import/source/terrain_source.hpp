// Terrain files, seen as streams of grid points in the store's projection.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <itin/import.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>

namespace itin {

/// The counts of what was read, and warnings.
struct ReadCounts {
  std::uint64_t read = 0;             ///< points handed on
  std::uint64_t voids = 0;            ///< posts without data
  std::uint64_t filtered = 0;         ///< number of posts left out by class or `where`
  GridBox bounds;                     ///< the box about the points handed on
  std::vector<std::string> warnings;  ///< one line each
};

/// One file to import. Opened and understood at planning time, read once, in bounded memory.
class TerrainSource {
 public:
  using Sink = std::function<void(std::span<const GridPoint>)>;
  virtual ~TerrainSource() = default;
  /// Streams every point, heights in grid units. Throws FileError, InputError, Cancelled.
  virtual ReadCounts read(const Sink& sink, Progress& progress) = 0;
  /// The source's information, complete (gap_basis, spacing, ...) only after read(); `vertices` is left to the
  /// importer.
  virtual SourceInfo info() const = 0;
  /// How much there is to read, in bytes or posts, whatever is at hand; progress is measured by it.
  virtual double size_hint() const = 0;
};

class LineLayer;  // line_layer.hpp
class TrueScale;  // true_scale.hpp

struct ImportPlan {
  std::string crs_wkt;  ///< the store's CRS: projected, in metres
  std::string crs_name;
  bool crs_chosen = false;  ///< a UTM zone was chosen
  Grid grid;
  std::unique_ptr<TrueScale> scale;  ///< the scale of that CRS; null where the plan adds neither points nor lines
  ImportPlan();
  ImportPlan(ImportPlan&&) noexcept;
  ImportPlan& operator=(ImportPlan&&) noexcept;
  ~ImportPlan();
  std::vector<std::unique_ptr<TerrainSource>> sources;
  std::vector<std::unique_ptr<LineLayer>> lines;  ///< where the call names a kind of theme
  std::vector<std::string> warnings;
};

/// Opens all sources and chooses CRS and grid; `existing` (may be null) fixes both. Nothing is written. A new store has
/// the CRS of options.to_crs, else that of the first source if it is metric and lengths in it are true there, else the
/// UTM zone there. Lengths must be true in the store's CRS wherever the sources say that they lie. The grid's origin is
/// the centre of the first source, rounded to a multiple of 2^29 resolutions in each axis: (0, 0) for nearly every CRS
/// at 1 cm. Throws InputError, FileError.
ImportPlan plan_import(const ImportOptions& options, const StoreMetadata* existing);

/// The plan of an import that adds neither terrain nor lines to a store.
ImportPlan plan_nothing(const StoreMetadata& existing);

}  // namespace itin
