#include "gdal/crs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <ogr_spatialref.h>
#include <ogr_srs_api.h>

#include <itin/celestial_body.hpp>
#include <itin/degrees.hpp>
#include <itin/error.hpp>
#include <itin/grid_axes.hpp>
#include <itin/grid_reference.hpp>
#include <itin/parallel.hpp>

#include "base/remembered.hpp"
#include "gdal/files/quiet_gdal.hpp"
#include "gdal/vertical_axis.hpp"

namespace itin {

namespace {

bool set_from(OGRSpatialReference& reference, const std::string& text) {
  constexpr const char* kOptions[] = {"ALLOW_NETWORK_ACCESS=NO", nullptr};
  const bool set = !text.empty() && reference.SetFromUserInput(text.c_str(), kOptions) == OGRERR_NONE;
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return set;
}

/// Tells whether PROJ knows a code, which may take it tenths of a second.
bool is_known(const std::string& code) {
  static Remembered<bool> known;
  return known.of(code, [&] {
    OGRSpatialReference reference;
    return set_from(reference, code);
  });
}

/// Removes a code that nobody knows, such as EPSG:0, EPSG:32767 or LOCAL:1: such a CRS is what its text says.
void forget_unknown_code(OGRSpatialReference& reference) {
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  if (!authority || !code || is_known(fmt::format("{}:{}", authority, code))) return;
  char* text = nullptr;
  reference.exportToPROJJSON(&text, nullptr);
  const std::unique_ptr<char, void (*)(void*)> owner(text, VSIFree);
  nlohmann::json json = nlohmann::json::parse(text != nullptr ? text : "", nullptr, false);
  if (json.is_object() && json.erase("id") > 0) set_from(reference, json.dump());
}

/// Returns an error about a CRS. `place` is a file, or the field that names the CRS between backticks.
InputError crs_error(const std::string& place, const std::string& what) {
  return InputError(fmt::format("{}: {}", place, what),
                    place.starts_with('`') ? place.substr(1, place.size() - 2) : "");
}

OGRSpatialReference understood(const std::string& text, const std::string& place) {
  OGRSpatialReference reference;
  if (!set_from(reference, text))
    throw crs_error(place, fmt::format("the CRS '{:.60}' is not understood; give it as EPSG:xxxx or WKT", text));
  forget_unknown_code(reference);
  return reference;
}

std::string name_of(const OGRSpatialReference& reference) {
  const char* authority = reference.GetAuthorityName(nullptr);
  const char* code = reference.GetAuthorityCode(nullptr);
  if (authority && code) return fmt::format("{}:{}", authority, code);
  return reference.GetName() ? reference.GetName() : "unnamed";
}

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

/// Tells whether both CRSs give the same coordinates, to within a millimetre, all over the area that `known` is used
/// in.
bool agree(const OGRSpatialReference& given, const OGRSpatialReference& known) {
  constexpr double kMetres = 0.001, kDegrees = 1e-8;
  double west = 0, south = 0, east = 0, north = 0;
  if (!given.IsSameGeogCS(&known) || given.IsProjected() != known.IsProjected() ||
      !known.GetAreaOfUse(&west, &south, &east, &north, nullptr))
    return false;
  if (east < west) east += 360;
  const std::unique_ptr<OGRSpatialReference> geographic(known.CloneGeogCS());
  geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Transformation to_given(OGRCreateCoordinateTransformation(geographic.get(), &given));
  const Transformation to_known(OGRCreateCoordinateTransformation(geographic.get(), &known));
  if (!to_given || !to_known) return false;
  const double tolerance = known.IsProjected() ? kMetres / known.GetLinearUnits() : kDegrees;
  for (const double across : {0.0, 0.5, 1.0}) {
    for (const double up : {0.0, 0.5, 1.0}) {
      double x = west + across * (east - west), y = south + up * (north - south), known_x = x, known_y = y;
      if (!to_given->Transform(1, &x, &y) || !to_known->Transform(1, &known_x, &known_y) ||
          !(std::hypot(x - known_x, y - known_y) <= tolerance))
        return false;
    }
  }
  return true;
}

/// Returns the code by which an authority knows a CRS that has none; empty where there is no such code. Takes PROJ a
/// second or more.
std::string code_of_match(const OGRSpatialReference& reference) {
  int count = 0;
  int* confidences = nullptr;
  OGRSpatialReferenceH* candidates = reference.FindMatches(nullptr, &count, &confidences);
  CPLFree(confidences);
  const std::unique_ptr<OGRSpatialReferenceH, void (*)(OGRSpatialReferenceH*)> owner(candidates, OSRFreeSRSArray);
  for (int i = 0; i < count; ++i) {
    // A match does not always know its area of use; the authority does.
    std::string code = name_of(*OGRSpatialReference::FromHandle(candidates[i]));
    if (agree(reference, understood(code, "PROJ"))) return code;
  }
  return {};
}

/// Replaces a CRS without a code by the one that an authority knows. ESRI's and other dialects come without codes, with
/// rounded parameters, and with datum names that coordinate operations are not found by.
void replace_by_authority(OGRSpatialReference& reference) {
  if (reference.GetAuthorityCode(nullptr)) return;
  static Remembered<std::string> codes;
  const std::string code = codes.of(wkt_of(reference), [&] { return code_of_match(reference); });
  if (!code.empty()) reference = understood(code, "PROJ");
}

/// Removes all but the horizontal part.
void strip_heights(OGRSpatialReference& reference) {
  if (reference.IsCompound()) reference.StripVertical();
  if (reference.GetAxesCount() == 3) reference.DemoteTo2D(nullptr);
  forget_unknown_code(reference);
  replace_by_authority(reference);
}

/// Returns authority:code, else WKT 2: a name alone would not be understood again.
std::string text_of(const OGRSpatialReference& reference) {
  return reference.GetAuthorityCode(nullptr) ? name_of(reference) : wkt_of(reference);
}

/// Returns the EPSG code of the whole CRS or of its part called `key`; empty where it has none.
std::string epsg_code(const OGRSpatialReference& reference, const char* key) {
  const char* authority = reference.GetAuthorityName(key);
  const char* code = reference.GetAuthorityCode(key);
  return authority && code && EQUAL(authority, "EPSG") ? code : "";
}

/// Returns the EPSG code from which the UTM zones of the CRS's own datum count (that of zone 1, less 1); WGS 84 where
/// the datum has no such zone.
int utm_base(const OGRSpatialReference& geographic, int zone, bool north) {
  const auto has_datum = [&](int code) {
    OGRSpatialReference datum;
    return datum.importFromEPSG(code) == OGRERR_NONE && geographic.IsSameGeogCS(&datum);
  };
  if (north && zone >= 28 && zone <= 38 && has_datum(4258)) return 25800;
  if (north && zone <= 23 && has_datum(4269)) return 26900;
  return north ? 32600 : 32700;
}

}  // namespace

std::string wkt_of(const OGRSpatialReference& reference) {
  char* wkt = nullptr;
  constexpr const char* kOptions[] = {"FORMAT=WKT2_2018", nullptr};
  reference.exportToWkt(&wkt, kOptions);
  std::string result = wkt ? wkt : "";
  CPLFree(wkt);
  return result;
}

OGRSpatialReference horizontal_crs(const std::string& text, const std::string& place) {
  const QuietGdal quiet;
  OGRSpatialReference reference = understood(text, place);
  strip_heights(reference);
  return reference;
}

bool same_crs(const OGRSpatialReference& a, const OGRSpatialReference& b) {
  constexpr const char* kOptions[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                      "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr};
  return a.IsSame(&b, kOptions);
}

Crs parse_crs(const std::string& text, const std::string& place) {
  Crs crs = parse_any_crs(text, place);
  if (crs.wkt.empty())
    throw crs_error(place, fmt::format("the CRS {} is only vertical; a horizontal one is needed", crs.name));
  return crs;
}

Crs parse_any_crs(const std::string& text, const std::string& place) {
  const QuietGdal quiet;
  OGRSpatialReference reference = understood(text, place);
  Crs crs;
  crs.name = name_of(reference);
  crs.whole = text_of(reference);
  crs.heights = vertical_axis(reference);
  if (reference.IsVertical() && !reference.IsCompound()) return crs;
  const bool has_code = reference.GetAuthorityCode(nullptr) != nullptr;
  std::string vertical_code = reference.IsCompound() ? epsg_code(reference, "VERT_CS") : "";
  if (!is_known("EPSG:" + vertical_code)) vertical_code.clear();
  strip_heights(reference);
  if (!reference.IsProjected() && !reference.IsGeographic())
    throw crs_error(place, fmt::format("the CRS {} is neither projected nor geographic", name_of(reference)));
  crs.wkt = wkt_of(reference);
  crs.name = name_of(reference);
  // The parts may have codes where the whole has none.
  if (!crs.heights || crs.heights->datum.empty()) crs.whole = text_of(reference);
  const std::string horizontal_code = epsg_code(reference, nullptr);
  if (!has_code && !horizontal_code.empty() && !vertical_code.empty())
    crs.whole = fmt::format("EPSG:{}+{}", horizontal_code, vertical_code);
  if (!reference.IsProjected()) return crs;
  crs.metres_per_axis = reference.GetLinearUnits();
  crs.east_north = runs_east_north(crs.wkt);
  return crs;
}

Crs utm_zone(const Crs& crs, Point2 position, const std::string& place) {
  const QuietGdal quiet;
  const OGRSpatialReference reference = understood(crs.wkt, place);
  std::unique_ptr<OGRSpatialReference> geographic(reference.CloneGeogCS());
  if (!geographic || !is_of_earth({geographic->GetSemiMajor(), 0}))
    throw InputError(fmt::format("{}: no UTM zone for {}; give `to_crs`", place, crs.name), "to_crs");
  geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  PointTransform(crs.wkt, wkt_of(*geographic), place).transform(std::span(&position.x, 1), std::span(&position.y, 1));
  const double longitude = in_degrees(position.x * geographic->GetAngularUnits()) + geographic->GetPrimeMeridian();
  const double latitude = in_degrees(position.y * geographic->GetAngularUnits());
  const std::optional<int> zone = utm_zone_at({longitude, latitude});
  if (!zone)
    throw InputError(
        fmt::format("{}: no UTM zone at longitude {:.4f}, latitude {:.4f}; give `to_crs`", place, longitude, latitude),
        "to_crs");
  return parse_crs(fmt::format("EPSG:{}", utm_base(*geographic, *zone, latitude >= 0) + *zone), place);
}

class PointTransform::Impl {
 public:
  explicit Impl(Transformation transformation) { copies_.push_back(std::move(transformation)); }

  void transform(std::span<double> x, std::span<double> y) {
    const std::size_t chunks = (x.size() + kChunk - 1) / kChunk;
    const std::size_t workers = std::min<std::size_t>(chunks, static_cast<std::size_t>(thread_count()));
    while (copies_.size() < workers) copies_.emplace_back(copies_.front()->Clone());
    const auto work = [&](std::size_t worker) {
      const QuietGdal quiet;
      for (std::size_t chunk = worker; chunk < chunks; chunk += workers) {
        const std::size_t first = chunk * kChunk, count = std::min(kChunk, x.size() - first);
        transform_chunk(*copies_[worker], x.subspan(first, count), y.subspan(first, count));
      }
    };
    // Single points are common, and starting threads is expensive.
    workers == 1 ? work(0) : parallel_for(workers, work);
  }

 private:
  // Between two CRSs GDAL chooses the operation that is best for the middle of the points it is given, so chunks must
  // not depend on the number of threads.
  static constexpr std::size_t kChunk = 1024;

  static void transform_chunk(OGRCoordinateTransformation& transformation, std::span<double> x, std::span<double> y) {
    std::vector<int> succeeded(x.size());
    transformation.Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr, succeeded.data());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!succeeded[i] || !std::isfinite(x[i]) || !std::isfinite(y[i]))
        x[i] = y[i] = std::numeric_limits<double>::quiet_NaN();
    }
  }

  std::vector<Transformation> copies_;  // one per worker: a transformation has a state
};

PointTransform::PointTransform(const std::string& source_wkt, const std::string& target_wkt, const std::string& place) {
  if (source_wkt == target_wkt) return;
  const QuietGdal quiet;
  const OGRSpatialReference source = horizontal_crs(source_wkt, place), target = horizontal_crs(target_wkt, place);
  if (same_crs(source, target)) return;
  Transformation transformation(OGRCreateCoordinateTransformation(&source, &target));
  if (!transformation)
    throw crs_error(place,
                    fmt::format("coordinates cannot be transformed from {} to {}", name_of(source), name_of(target)));
  impl_ = std::make_unique<Impl>(std::move(transformation));
}

PointTransform::PointTransform(PointTransform&&) noexcept = default;
PointTransform& PointTransform::operator=(PointTransform&&) noexcept = default;
PointTransform::~PointTransform() = default;

void PointTransform::transform(std::span<double> x, std::span<double> y) const {
  if (impl_) impl_->transform(x, y);
}

}  // namespace itin
