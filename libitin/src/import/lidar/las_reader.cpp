#include "import/lidar/las_reader.hpp"

#include <bitset>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "import/lidar/las_file.hpp"
#include "import/lidar/las_projection.hpp"

namespace itin {

namespace {

using Classes = std::bitset<256>;

Classes kept_classes(const std::string& path, const std::vector<int>& classes) {
  constexpr int kLowNoise = 7, kHighNoise = 18;
  Classes kept;
  if (classes.empty()) return kept.set().reset(kLowNoise).reset(kHighNoise);
  for (const int c : classes) {
    if (c < 0 || c > 255)
      throw InputError(fmt::format("{}: `classes` {}: LAS classes are 0 to 255", path, c), "classes");
    kept.set(static_cast<std::size_t>(c));
  }
  return kept;
}

class LasReader final : public PointReader {
 public:
  LasReader(const std::string& path, const ImportOptions& options)
      : file_(path), projection_(las_projection(file_)), kept_(kept_classes(path, options.classes)) {
    if (file_.header().point_count == 0) throw FileError(path, "holds no points");
    extent_ = find_extent();
    centre_ = {extent_.xmin + extent_.width() / 2, extent_.ymin + extent_.height() / 2};
  }

  const std::string& path() const override { return file_.path(); }
  std::string crs() const override { return projection_.crs; }
  std::optional<LinearUnit> height_unit() const override { return projection_.height_unit; }
  std::vector<std::string> warnings() const override {
    const std::uint64_t more = file_.records_not_promised();
    if (more == 0) return {};
    return {fmt::format("{}: the header promises {} points, but the file has room for {}; the others were not read",
                        path(), file_.header().point_count, file_.header().point_count + more)};
  }
  Point2 centre() const override { return centre_; }
  Box extent() const override { return extent_; }
  double size_hint() const override { return static_cast<double>(file_.header().point_count); }

  std::uint64_t read(const Sink& sink) override {
    PointBatch batch;
    std::uint64_t filtered = 0;
    const auto take = [&](std::span<const LasPoint> points, double fraction) {
      batch.clear();
      for (const LasPoint& p : points) {
        if (!p.withheld && kept_[p.classification])
          batch.add(p.x, p.y, p.z);
        else
          ++filtered;
      }
      sink(batch, fraction);
    };
    file_.read(take);
    return filtered;
  }

 private:
  /// Finds the extent. The header's box is a claim; a writer that leaves it empty must not move the store's grid to (0,
  /// 0).
  Box find_extent() const {
    const Box& claimed = file_.header().bounds;
    const bool finite = std::isfinite(claimed.width()) && std::isfinite(claimed.height()) && !claimed.empty();
    const LasPoint first = file_.first_point();
    if (!finite || !claimed.contains({first.x, first.y})) return {first.x, first.y, first.x, first.y};
    return claimed;
  }

  LasFile file_;
  LasProjection projection_;
  Classes kept_;
  Box extent_;
  Point2 centre_;
};

}  // namespace

std::unique_ptr<PointReader> open_las_reader(const std::string& path, const ImportOptions& options) {
  return std::make_unique<LasReader>(path, options);
}

}  // namespace itin
