#include "import/scattered_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <itin/file_digest.hpp>

namespace itin {

namespace {

/// The default gap, in mean point spacings.
constexpr double kGapSpacings = 100;

double mean_spacing(const Box& bounds, std::uint64_t points) {
  if (points == 0) return 0;
  const auto n = static_cast<double>(points);
  return std::max(std::sqrt(bounds.width() * bounds.height() / n), std::max(bounds.width(), bounds.height()) / n);
}

}  // namespace

double default_gap(const Box& bounds, std::uint64_t points) {
  return kGapSpacings * mean_spacing(bounds, points);
}

namespace {

class ScatteredTerrain final : public TerrainSource {
 public:
  ScatteredTerrain(std::unique_ptr<PointReader> reader, const Crs& crs, double metres_per_height, double max_gap,
                   const SourceContext& context)
      : reader_(std::move(reader)),
        grid_(context.grid),
        placement_(reader_->path(), crs, metres_per_height, context),
        max_gap_(max_gap) {
    info_.path = reader_->path();
    info_.kind = "terrain";
    info_.source_crs = crs.whole;
  }

  double size_hint() const override { return reader_->size_hint(); }
  SourceInfo info() const override { return info_; }

  ReadCounts read(const Sink& sink, Progress& progress) override {
    const std::string stage = "reading " + reader_->path();
    GridBox bounds;
    std::vector<GridPoint> points;
    const std::uint64_t filtered = reader_->read([&](PointBatch& batch, double fraction) {
      progress.throw_if_cancelled();
      placement_.place(batch.x, batch.y, batch.z, points);
      for (const GridPoint& p : points) bounds.extend(p.x, p.y);
      if (!points.empty()) sink(points);
      progress.report(stage, fraction);
    });
    ReadCounts counts = placement_.counts();
    counts.filtered = filtered;
    info_.spacing = mean_spacing(grid_.box(bounds), counts.read);
    const double gap = max_gap_ > 0 ? max_gap_ : kGapSpacings * info_.spacing;
    info_.gap_basis = {gap, 0, 0, gap};
    info_.sha256 = file_sha256(reader_->path(), progress);
    info_.imported = utc_now();
    return counts;
  }

 private:
  std::unique_ptr<PointReader> reader_;
  Grid grid_;
  Placement placement_;
  double max_gap_;
  SourceInfo info_;
};

class ScatteredFile final : public SourceFile {
 public:
  ScatteredFile(std::unique_ptr<PointReader> reader, const ImportOptions& options)
      : reader_(std::move(reader)),
        crs_(source_crs(reader_->path(), options.crs, reader_->crs())),
        max_gap_(options.max_gap),
        warnings_(reader_->warnings()) {
    HeightUnit unit = height_unit(reader_->path(), reader_->metres_per_height(), crs_);
    metres_per_height_ = unit.metres;
    if (!unit.warning.empty()) warnings_.push_back(std::move(unit.warning));
  }

  Crs crs() const override { return crs_; }
  const std::string& path() const override { return reader_->path(); }
  Point2 centre() const override { return reader_->centre(); }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::unique_ptr<TerrainSource> bind(const SourceContext& context) override {
    return std::make_unique<ScatteredTerrain>(std::move(reader_), crs_, metres_per_height_, max_gap_, context);
  }

 private:
  std::unique_ptr<PointReader> reader_;
  Crs crs_;
  double max_gap_;
  double metres_per_height_ = 1;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<SourceFile> scattered_source(std::unique_ptr<PointReader> reader, const ImportOptions& options) {
  return std::make_unique<ScatteredFile>(std::move(reader), options);
}

}  // namespace itin
