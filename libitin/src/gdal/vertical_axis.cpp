#include "gdal/vertical_axis.hpp"

#include <cpl_string.h>
#include <ogr_spatialref.h>

#include "gdal/linear_unit.hpp"

namespace itin {

namespace {

constexpr const char* kVertical = "VERT_CS";

/// Returns the name of the datum; empty where it is not known. The datum matters rather than the vertical CRS: NAVD88
/// in feet and in metres are one.
std::string datum_of(const OGRSpatialReference& reference) {
  const char* datum = reference.GetAttrValue("VERT_DATUM");
  // Files give these names to datums they do not know.
  return !datum || EQUALN(datum, "unknown", 7) || EQUALN(datum, "unnamed", 7) ? "" : datum;
}

}  // namespace

std::optional<HeightAxis> vertical_axis(const OGRSpatialReference& reference) {
  HeightAxis axis;
  OGRAxisOrientation towards = OAO_Up;
  const char* name = nullptr;
  if (reference.IsCompound() || reference.IsVertical()) {
    axis.datum = datum_of(reference);
    axis.metres = reference.GetTargetLinearUnits(kVertical, &name);
    reference.GetAxis(kVertical, 0, &towards);
  } else if (reference.GetAxesCount() == 3) {
    axis.datum = kEllipsoid;
    reference.GetAxis(nullptr, 2, &towards, &axis.metres);
  } else {
    return std::nullopt;
  }
  axis.unit = unit_name(axis.metres, name ? name : "unnamed");
  axis.down = towards == OAO_Down;
  return axis;
}

}  // namespace itin
