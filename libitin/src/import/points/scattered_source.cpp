#include "import/points/scattered_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/counted.hpp>
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
  ScatteredTerrain(std::unique_ptr<PointReader> reader, const Crs& crs, const SourceHeights& heights, double max_gap,
                   const SourceContext& context)
      : reader_(std::move(reader)),
        grid_(context.grid),
        placement_(reader_->path(), crs, heights.axis, context, Placement::Missing::kNotDeclared),
        max_gap_(max_gap) {
    info_.path = reader_->path();
    info_.kind = "terrain";
    info_.source_crs = heights.crs;
  }

  double size_hint() const override { return reader_->size_hint(); }
  SourceInfo info() const override { return info_; }

  ReadCounts read(const Sink& sink, Progress& progress) override {
    const std::string stage = "reading " + reader_->path();
    std::vector<GridPoint> points;
    const std::uint64_t filtered = reader_->read([&](PointBatch& batch, double fraction) {
      progress.throw_if_cancelled();
      placement_.place(batch.x, batch.y, batch.z, points);
      if (!points.empty()) sink(points);
      progress.report(stage, fraction);
    });
    ReadCounts counts = placement_.counts();
    counts.filtered = filtered;
    if (const std::uint64_t none = reader_->without_geometry(); none > 0)
      counts.warnings.push_back(
          fmt::format("{}: {} without geometry left out", reader_->path(), counted(none, "feature")));
    if (std::string warning = reader_->warning(); !warning.empty()) counts.warnings.push_back(std::move(warning));
    info_.spacing = mean_spacing(grid_.box(counts.bounds), counts.read);
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
        crs_(source_crs(reader_->path(), options.crs, reader_->crs(),
                        options.z_field.empty() ? Elevations::in_coordinates : Elevations::in_field)),
        max_gap_(options.max_gap),
        warnings_(reader_->warnings()) {
    heights_ = source_heights(reader_->path(), reader_->height_unit(), crs_);
    if (!heights_.warning.empty()) warnings_.push_back(heights_.warning);
  }

  Crs crs() const override { return crs_; }
  const std::string& path() const override { return reader_->path(); }
  Point2 centre() const override { return reader_->centre(); }
  Box extent() const override { return reader_->extent(); }
  std::vector<std::string> warnings() const override { return warnings_; }
  std::unique_ptr<TerrainSource> bind(const SourceContext& context) override {
    return std::make_unique<ScatteredTerrain>(std::move(reader_), crs_, heights_, max_gap_, context);
  }

 private:
  std::unique_ptr<PointReader> reader_;
  Crs crs_;
  double max_gap_;
  SourceHeights heights_;
  std::vector<std::string> warnings_;
};

}  // namespace

std::unique_ptr<SourceFile> scattered_source(std::unique_ptr<PointReader> reader, const ImportOptions& options) {
  return std::make_unique<ScatteredFile>(std::move(reader), options);
}

}  // namespace itin
