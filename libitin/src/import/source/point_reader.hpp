// Files of scattered points, whatever their format, seen as one stream of coordinates as the file has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

#include "gdal/linear_unit.hpp"

namespace itin {

/// Some points in the file's own coordinates and units. The axes are easting (or longitude), northing (or latitude) and
/// height; a height of NaN is one the file leaves out.
struct PointBatch {
  std::vector<double> x, y, z;

  std::size_t size() const { return x.size(); }
  void add(double easting, double northing, double height) {
    x.push_back(easting), y.push_back(northing), z.push_back(height);
  }
  void clear() { x.clear(), y.clear(), z.clear(); }
};

/// Readers hand on about this many points at a time: a few hundred kilobytes.
inline constexpr std::size_t kPointBatchSize = 16384;

/// A point file that was opened and understood: its header was read, not its points.
class PointReader {
 public:
  /// Receives a batch; `fraction` of the file has been read so far. The receiver may change the batch.
  using Sink = std::function<void(PointBatch& batch, double fraction)>;

  virtual ~PointReader() = default;
  virtual const std::string& path() const = 0;
  /// The CRS that the file itself states: authority:code or WKT; empty if it says nothing.
  virtual std::string crs() const = 0;
  /// The unit of the heights, where the file states it apart from its CRS.
  virtual std::optional<LinearUnit> height_unit() const { return std::nullopt; }
  /// Assumptions made on opening, one line each.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// A position amid the points.
  virtual Point2 centre() const = 0;
  /// The box of the points, so far as it is known without reading them: at least the centre.
  virtual Box extent() const { return {centre().x, centre().y, centre().x, centre().y}; }
  /// The number of features without geometry that read() has passed over.
  virtual std::uint64_t without_geometry() const { return 0; }
  /// What read() has found to warn of; empty where it has found nothing.
  virtual std::string warning() const { return {}; }
  /// How much there is to read, in bytes or points, whatever is at hand; progress is measured by it.
  virtual double size_hint() const = 0;
  /// Streams all points in bounded memory, and returns the number left out by class or attribute filter. Exceptions of
  /// the sink pass through. Throws FileError, InputError.
  virtual std::uint64_t read(const Sink& sink) = 0;
};

}  // namespace itin
