// Reads LAS 1.0 to 1.4, point formats 0 to 10, front to back in bounded memory. It follows the ASPRS LAS specification
// 1.4-R15.
//
//   LasFile file("tile.las");
//   file.read([](std::span<const LasPoint> points, double fraction) { ... });
//
// Every count, offset and length in the file is checked against the file's size before it is used, so that truncated
// and damaged files end in a FileError naming the offset, never in a large allocation or a wild read.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include <itin/geometry.hpp>

#include "import/lidar/laz/laz_layout.hpp"

namespace itin {

struct LasPoint {
  double x = 0, y = 0, z = 0;  ///< in the file's units, scale and offset applied
  std::uint8_t classification = 0;
  bool withheld = false;  ///< deleted, as the specification puts it
};

struct LasHeader {
  int minor_version = 0;
  int point_format = 0;  ///< 0 to 10, without the bits that mark compression
  bool compressed = false;
  bool prefers_wkt = false;  ///< global encoding says that the CRS is the WKT record
  std::uint16_t header_size = 0;
  std::uint16_t record_length = 0;  ///< bytes of a point: those of the format, and extra ones
  std::uint64_t point_offset = 0;
  std::uint32_t vlr_count = 0;
  std::uint64_t evlr_offset = 0;
  std::uint32_t evlr_count = 0;
  std::uint64_t point_count = 0;
  std::array<double, 3> scale{}, offset{};
  Box bounds;  ///< as the header claims
};

/// The CRS by the (extended) variable length records.
struct LasProjectionRecords {
  std::map<std::uint16_t, std::uint16_t> geo_keys;  ///< GeoTIFF keys whose value is a code
  std::string wkt;
};

class LasFile {
 public:
  using Sink = std::function<void(std::span<const LasPoint> points, double fraction)>;

  /// Reads the header and the records that matter. Throws FileError, also for points compressed in a way that is not
  /// read, see laz_layout().
  explicit LasFile(std::string path);

  const std::string& path() const { return path_; }
  const LasHeader& header() const { return header_; }
  const LasProjectionRecords& projection() const { return projection_; }
  std::uint64_t file_size() const { return file_size_; }
  /// The number of records between the points that the header promises and whatever follows them; 0 unless the header's
  /// count is wrong.
  std::uint64_t records_not_promised() const;
  /// Reads the first point, without its attributes. Precondition: at least one point.
  LasPoint first_point() const;
  /// Reads all points in the file's order. Throws FileError, and what the sink throws.
  void read(const Sink& sink) const;

 private:
  void read_plain(const Sink& sink) const;
  void read_compressed(const Sink& sink) const;

  std::string path_;
  std::uint64_t file_size_ = 0;
  LasHeader header_;
  LasProjectionRecords projection_;
  std::optional<LazLayout> laz_;  ///< if the points are compressed
};

}  // namespace itin
