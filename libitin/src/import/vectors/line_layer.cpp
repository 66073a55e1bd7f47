#include "import/vectors/line_layer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/height_limit.hpp>

#include "gdal/files/quiet_gdal.hpp"
#include "import/points/scattered_source.hpp"
#include "import/source/findings.hpp"
#include "import/source/middle_place.hpp"

namespace itin {

namespace {

constexpr const char* kWithoutLength = "has no length on the store's grid";

bool has_length(const std::vector<GridPoint>& line) {
  return std::any_of(line.begin(), line.end(),
                     [&](const GridPoint& p) { return p.x != line.front().x || p.y != line.front().y; });
}

Elevations elevations_of(const ImportOptions& options) {
  if (!is_terrain(options.kind.value())) return Elevations::none;
  return options.z_field.empty() ? Elevations::in_coordinates : Elevations::in_field;
}

}  // namespace

LineLayer::LineLayer(const std::string& path, const ImportOptions& options)
    : layer_(path, options, "a layer of lines"),
      fields_(layer_.feature_fields(options)),
      kind_(options.kind.value()),
      max_gap_(options.max_gap),
      crs_(source_crs(path, options.crs, layer_.crs(), elevations_of(options))) {
  layer_.select(options);
  heights_ = source_heights(path, std::nullopt, crs_);
  if (!heights_.warning.empty() && is_terrain(kind_)) warnings_.push_back(heights_.warning);
  find_centre();
  info_.path = path;
  info_.kind = name_of(kind_);
  info_.theme = options.theme;
  info_.makes_room = is_terrain(kind_) && !options.stay;
  info_.source_crs = heights_.crs;
}

void LineLayer::find_centre() {
  std::vector<Point2> places;
  layer_.rewind();
  while (places.size() < kFirstPlaces) {
    const auto feature = layer_.next();
    if (!feature) break;
    const std::vector<Line> lines = lines_of(*feature);
    if (!lines.empty()) places.push_back({lines.front().x.front(), lines.front().y.front()});
  }
  if (!places.empty()) {
    centre_ = middle_place(std::move(places));
    return;
  }
  throw FileError(path(), fmt::format("layer '{}' holds no lines or polygons of two or more vertices{}", layer_.name(),
                                      layer_.filtered() > 0 ? " that match `where`" : ""));
}

std::vector<LineLayer::Line> LineLayer::lines_of(const OGRFeature& feature) const {
  std::vector<Line> lines;
  if (!has_geometry(feature)) return lines;
  const OGRGeometry& geometry = *feature.GetGeometryRef();
  if (geometry.hasCurveGeometry()) {
    const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
    collect(*linear, feature, lines);
  } else {
    collect(geometry, feature, lines);
  }
  return lines;
}

void LineLayer::collect(const OGRGeometry& geometry, const OGRFeature& feature, std::vector<Line>& lines) const {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (OGR_GT_IsSubClassOf(type, wkbLineString)) {
    add(*geometry.toSimpleCurve(), feature, lines);
  } else if (OGR_GT_IsSubClassOf(type, wkbPolygon)) {
    for (const OGRLinearRing* ring : *geometry.toPolygon()) add(*ring, feature, lines);
  } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
    for (const OGRGeometry* part : *geometry.toGeometryCollection()) collect(*part, feature, lines);
  } else {
    const bool solid = OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) && may_be_raised(kind_);
    throw InputError(
        fmt::format("{}: is a {}; {} are lines or polygons{}", layer_.place(feature), OGRGeometryTypeToName(type),
                    name_of(kind_), solid ? ", or models of what stands, with `height_field` or `height`" : ""),
        "height_field");
  }
}

void LineLayer::add(const OGRSimpleCurve& curve, const OGRFeature& feature, std::vector<Line>& lines) const {
  const int count = curve.getNumPoints();
  if (count < 2) return;
  const bool needs_height = is_terrain(kind_);
  if (needs_height && !layer_.has_height_field() && !curve.Is3D()) {
    throw InputError(fmt::format("{}: has no heights, which {} need; name the field of the height with `z_field`",
                                 layer_.place(feature), name_of(kind_)),
                     "z_field");
  }
  const double of_feature = needs_height && layer_.has_height_field() ? layer_.height(feature) : 0;
  Line line;
  for (int i = 0; i < count; ++i) {
    const double z = needs_height && !layer_.has_height_field() ? curve.getZ(i) : of_feature;
    if (!std::isfinite(curve.getX(i)) || !std::isfinite(curve.getY(i)))
      throw InputError(fmt::format("{}: a coordinate is not a finite number", layer_.place(feature)));
    if (const double metres = z * heights_.axis.metres; !is_height(metres) && !std::isnan(z) && !is_missing_mark(z))
      require_height(metres, layer_.place(feature));
    line.x.push_back(curve.getX(i));
    line.y.push_back(curve.getY(i));
    line.z.push_back(z);
  }
  lines.push_back(std::move(line));
}

ReadCounts LineLayer::read(const SourceContext& context, const Sink& sink, Progress& progress) {
  const std::string stage = "reading " + path();
  Placement placement(path(), crs_, heights_.axis, context, Placement::Missing::kNotDeclared);
  Findings findings(path());
  std::vector<GridPoint> points;
  std::uint64_t done = 0, vertices = 0;
  bool level = is_terrain(kind_) && !layer_.has_height_field();  // as far as Z tells, at 0
  layer_.rewind();
  features_ = 0;
  while (const auto feature = layer_.next()) {
    progress.throw_if_cancelled();
    std::vector<Line> lines = lines_of(*feature);
    for (const Line& line : lines)
      level = level && std::all_of(line.z.begin(), line.z.end(), [](double z) { return z == 0; });
    std::size_t taken = 0;
    const char* why_not = has_geometry(*feature) ? kWithoutLength : "has no geometry";
    for (Line& line : lines) {
      placement.place(line.x, line.y, line.z, points);
      const bool complete = points.size() == line.z.size();
      if (!complete || !has_length(points)) {
        why_not = complete ? kWithoutLength : "has a vertex without a height, or without a place in the store's CRS";
        continue;
      }
      vertices += points.size();
      if (taken++ == 0 && fields_.any()) sink.feature(fields_.record(*feature));
      sink.line(points);
    }
    features_ += taken > 0 ? 1 : 0;
    if (taken == 0) {
      findings.add(fmt::format("feature {}: passed over: {}", feature->GetFID(), why_not));
    } else if (taken < lines.size()) {
      findings.add(fmt::format("feature {}: {} of its {} lines passed over: it {}", feature->GetFID(),
                               lines.size() - taken, lines.size(), why_not));
    }
    progress.report(stage,
                    static_cast<double>(++done) / static_cast<double>(std::max<std::uint64_t>(1, layer_.matching())));
  }
  ReadCounts counts = placement.counts();
  counts.read = vertices;
  counts.filtered = layer_.filtered();
  if (std::string warning = level ? layer_.zero_heights() : ""; !warning.empty())
    counts.warnings.push_back(std::move(warning));
  for (std::string& line : findings.lines()) counts.warnings.push_back(std::move(line));
  for (std::string& line : fields_.warnings()) counts.warnings.push_back(std::move(line));
  describe(counts, context.grid, progress);
  return counts;
}

void LineLayer::describe(const ReadCounts& counts, const Grid& grid, Progress& progress) {
  // Contours are ground by themselves, as scattered points are; other lines only add to it.
  if (kind_ == ThemeKind::Contours) {
    const double gap = max_gap_ > 0 ? max_gap_ : default_gap(grid.box(counts.bounds), counts.read);
    info_.gap_basis = {gap, 0, 0, gap};
  }
  info_.sha256 = file_sha256(path(), progress);
  info_.imported = utc_now();
}

}  // namespace itin
