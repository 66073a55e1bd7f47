#include "import/footprints/footprint_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "base/stoppable.hpp"
#include "features/mesh/feature_mesh.hpp"
#include "features/mesh/united_parts.hpp"
#include "gdal/crs.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "import/footprints/written_height.hpp"
#include "import/source/crs_doubts.hpp"
#include "import/source/findings.hpp"
#include "import/source/layers/source_layer.hpp"
#include "import/source/source_context.hpp"

namespace itin {

namespace {

struct Fields {
  int height = -1, eaves = -1, base = -1;
};

class FootprintLayer {
 public:
  FootprintLayer(const FootprintQuery& query, const std::string& to_crs, const Grid& grid)
      : query_(query),
        grid_(grid),
        findings_(query.path),
        dataset_(open_vector_file(query.path, nullptr, "a layer of polygons or lines")) {
    layer_ = &choose_layer(*dataset_, query.path, query.layer);
    fields_ = {field(query.height_field), field(query.eaves_field), field(query.base_field)};
    kept_.emplace(*layer_, query.path, query.kept);
    source_.fields = kept_->fields();
    source_.filtered = select_features(*layer_, query.path, query.where);
    const OGRSpatialReference* own = layer_->GetSpatialRef();
    const Crs crs = source_crs(query.path, query.crs, own ? wkt_of(*own) : std::string(), elevations());
    if (elevations() != Elevations::none && query.datums != nullptr) query.datums->add(crs, query.path);
    transform_.emplace(crs.wkt, to_crs, query.path);
    OGREnvelope box;
    if (layer_->GetExtent(&box) == OGRERR_NONE)
      source_.warnings = crs_doubts(query.path, crs, {box.MinX, box.MinY, box.MaxX, box.MaxY});
    SourceHeights heights = source_heights(query.path, std::nullopt, crs);
    axis_ = std::move(heights.axis);
    source_.crs = std::move(heights.crs);
    const auto heights_at_hand = field_called_height(*layer_, HeightOf::kFeatures);
    if (heights_at_hand && fields_.height < 0 && fields_.eaves < 0)
      source_.warnings.push_back(
          fmt::format("{0}: the field '{1}' is not used; if it holds heights above the ground, give `height_field` {1}",
                      query.path, *heights_at_hand));
    const bool heights_used = fields_.height >= 0 || fields_.eaves >= 0 || fields_.base >= 0;
    if (heights_used && !heights.warning.empty()) source_.warnings.push_back(std::move(heights.warning));
  }

  FootprintSource read(Progress& progress) {
    const std::string stage = "reading " + query_.path;
    const auto all = static_cast<double>(std::max<GIntBig>(1, layer_->GetFeatureCount()));
    std::uint64_t done = 0;
    layer_->ResetReading();
    for (;;) {
      progress.throw_if_cancelled();
      progress.report(stage, std::min(1.0, static_cast<double>(done++) / all));
      const OGRFeatureUniquePtr feature = next_feature(*layer_, query_.path);
      if (!feature) break;
      add(*feature);
    }
    if (marks_ > 0) source_.warnings.push_back(warning_of_marks(query_.path, marks_, mark_));
    for (std::string& line : findings_.lines()) source_.warnings.push_back(std::move(line));
    for (std::string& line : kept_->warnings()) source_.warnings.push_back(std::move(line));
    if (unused_z_)
      source_.warnings.push_back(
          query_.path +
          ": Z of the footprints is not used: they stand on the terrain, or at the elevation in `base_field`");
    return std::move(source_);
  }

 private:
  Elevations elevations() const {
    if (!query_.base_field.empty()) return Elevations::in_field;
    return query_.z == FootprintZ::ignored ? Elevations::none : Elevations::in_coordinates;
  }

  int field(const std::string& name) { return name.empty() ? -1 : field_of_layer(*layer_, query_.path, name); }

  void add(const OGRFeature& feature) {
    FootprintFeature footprint;
    FeatureRecord record = kept_->record(feature);
    footprint.name = record.name.empty() ? fmt::format("feature {}", feature.GetFID()) : record.name;
    footprint.kind = query_.kind;
    footprint.roof = query_.roof;
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (!geometry || geometry->IsEmpty()) return pass_over(footprint.name, "has no geometry");
    // Arcs become chords here.
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
    try {
      std::vector<FeaturePart> parts;
      if (!linear || !add_parts(*linear, parts))
        return pass_over(footprint.name, std::string("is a ") + geometry->getGeometryName());
      if (parts.empty()) return pass_over(footprint.name, "has no length");
      unite(parts, footprint);
      if (footprint.rings.empty()) return pass_over(footprint.name, "has no area");
    } catch (const InputError& error) {
      return pass_over(footprint.name, error.what());
    } catch (const OverlayError& error) {
      return pass_over(footprint.name, error.what());
    }
    add_heights(feature, footprint);
    source_.features.push_back(std::move(footprint));
    if (kept_->any()) source_.records.push_back(std::move(record));
  }

  void pass_over(const std::string& name, const std::string& why) {
    findings_.add(fmt::format("{}: passed over: {}", name, why));
  }

  /// Returns false for a kind of geometry that has no footprint.
  bool add_parts(const OGRGeometry& geometry, std::vector<FeaturePart>& parts) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon || type == wkbTriangle) {
      FeaturePart& part = parts.emplace_back();
      for (const OGRLinearRing* ring : *geometry.toPolygon()) part.push_back(plan(*ring));
      return true;
    }
    if (type == wkbLineString) {
      FeaturePart band = band_about(plan(*geometry.toLineString()), query_.thickness, grid_);
      if (!band.empty()) parts.push_back(std::move(band));
      return true;
    }
    if (type == wkbPolyhedralSurface || type == wkbTIN) return add_members(*geometry.toPolyhedralSurface(), parts);
    if (type != wkbMultiPolygon && type != wkbMultiLineString && type != wkbGeometryCollection) return false;
    return add_members(*geometry.toGeometryCollection(), parts);
  }

  /// Adds all members but walls of models in three dimensions, which have no area in plan.
  template <class Geometry>
  bool add_members(const Geometry& geometry, std::vector<FeaturePart>& parts) {
    for (const auto* member : geometry) {
      if (!add_parts(*member, parts)) return false;
      if (geometry.Is3D() && !parts.empty() && is_wall(parts.back())) parts.pop_back();
    }
    return true;
  }

  /// Whether a part is narrower in plan than a step of the grid.
  bool is_wall(const FeaturePart& part) const {
    double doubled_area = 0, length = 0;
    const PlanRing& ring = part.front();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point2 &a = ring[i], &b = ring[(i + 1) % ring.size()], &o = ring.front();
      doubled_area += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
    return std::abs(doubled_area) < length * grid_.resolution;
  }

  void unite(const std::vector<FeaturePart>& parts, FootprintFeature& footprint) {
    UnitedParts united = united_parts(parts, grid_);
    if (united.repaired)
      findings_.add(fmt::format("{}: a part crosses or touches itself; taken by the even-odd rule", footprint.name));
    footprint.rings = std::move(united.rings);
  }

  PlanRing plan(const OGRSimpleCurve& line) {
    const auto count = static_cast<std::size_t>(line.getNumPoints());
    std::vector<double> x(count), y(count);
    for (std::size_t i = 0; i < count; ++i) {
      const int at = static_cast<int>(i);
      x[i] = line.getX(at), y[i] = line.getY(at);
      if (!line.Is3D() || is_mark(line.getZ(at))) continue;
      const double z = line.getZ(at) * axis_.factor();
      lowest_ = std::min(lowest_, z), highest_ = std::max(highest_, z);
    }
    transform_->transform(x, y);
    PlanRing ring;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
        throw InputError("a vertex has no place in the CRS of the store");
      ring.push_back({x[i], y[i]});
    }
    return ring;
  }

  /// Tells whether a height marks missing data, and counts it if so.
  bool is_mark(double height) {
    if (!is_usual_nodata(height)) return false;
    ++marks_, mark_ = height;
    return true;
  }

  /// Returns what stands in a field, in metres. A number counts units of this length; a text may have its own.
  std::optional<double> metres_in(const OGRFeature& feature, int index, double unit) {
    if (index < 0 || !feature.IsFieldSetAndNotNull(index)) return std::nullopt;
    const OGRFieldDefn& definition = *feature.GetFieldDefnRef(index);
    const bool text = definition.GetType() == OFTString;
    if (const auto written = text ? written_height(feature.GetFieldAsString(index)) : std::nullopt) return written;
    const double value = feature.GetFieldAsDouble(index);
    const bool number = !text || CPLGetValueType(feature.GetFieldAsString(index)) != CPL_VALUE_STRING;
    if (!number || std::isnan(value) || is_missing_mark(value)) {
      findings_.add(fmt::format("feature {}: {} '{}' is not a number; taken as missing", feature.GetFID(),
                                definition.GetNameRef(), feature.GetFieldAsString(index)));
      return std::nullopt;
    }
    if (is_mark(value)) return std::nullopt;
    const double metres = value * unit;
    if (!is_height(metres))
      require_height(metres, fmt::format("{}: feature {}: {}", query_.path, feature.GetFID(), definition.GetNameRef()));
    return metres;
  }

  void add_heights(const OGRFeature& feature, FootprintFeature& footprint) {
    const double unit = query_.storey.value_or(axis_.metres);
    footprint.height = metres_in(feature, fields_.height, unit);
    footprint.eaves = metres_in(feature, fields_.eaves, unit);
    footprint.base = metres_in(feature, fields_.base, axis_.factor());
    const bool has_z = lowest_ <= highest_ && (lowest_ != 0 || highest_ != 0);
    if (has_z && query_.z == FootprintZ::ignored) unused_z_ = true;
    if (has_z && query_.z == FootprintZ::base && !footprint.base) footprint.base = lowest_;
    if (has_z && query_.z == FootprintZ::top && !footprint.height && footprint.base)
      footprint.height = highest_ - *footprint.base;
    if (!footprint.height && !footprint.eaves) footprint.height = query_.height;
  }

  const FootprintQuery& query_;
  const Grid& grid_;
  Findings findings_;
  GDALDatasetUniquePtr dataset_;
  OGRLayer* layer_ = nullptr;
  Fields fields_;
  std::optional<FeatureFields> kept_;
  std::optional<PointTransform> transform_;
  HeightAxis axis_;
  double lowest_ = 0, highest_ = 0;  ///< elevations that Z of the current feature has, metres
  bool unused_z_ = false;
  std::uint64_t marks_ = 0;  ///< heights that customarily mark missing data
  double mark_ = 0;          ///< one of them
  FootprintSource source_;
};

}  // namespace

FootprintSource read_footprints(const FootprintQuery& query, const std::string& to_crs, const Grid& grid,
                                Progress& progress) {
  const QuietGdal quiet;
  const Stoppable stoppable(progress);
  return FootprintLayer(query, to_crs, grid).read(progress);
}

}  // namespace itin
