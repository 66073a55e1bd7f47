// The rule that lengths on a store's grid are lengths on the ground.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gdal/scale_meter.hpp"
#include "import/source/source_context.hpp"

namespace itin {

class TrueScale {
 public:
  /// `crs` is the CRS of a store, a new one or one that exists.
  TrueScale(Crs crs, bool store_exists) : crs_(std::move(crs)), store_exists_(store_exists), meter_(crs_) {}

  /// The scale where the file's points lie, so far as that is known before they are read. Throws InputError where they
  /// have no place in the CRS.
  GridScale of(const OpenedFile& file);
  /// Throws InputError, which names a remedy, where lengths at the file's points are not true.
  void require(const OpenedFile& file);
  /// Requires true lengths of points in this box in the CRS, from the file `path`.
  void require(const std::string& path, const Box& area) const;
  const ScaleMeter& meter() const { return meter_; }

 private:
  std::vector<Point2> places_of(const OpenedFile& file);
  void require(const std::string& path, std::span<const Point2> places, const GridScale& scale) const;
  std::string nearer_crs(std::span<const Point2> places) const;

  Crs crs_;
  bool store_exists_;
  ScaleMeter meter_;
  // Files of one import mostly have one CRS, and a transformation takes long to find.
  std::string file_wkt_;
  std::optional<PointTransform> from_file_;
};

}  // namespace itin
