#include "import/source/source_heights.hpp"

#include <cmath>

#include <fmt/format.h>

namespace itin {

namespace {

bool is_metre(double metres) {
  return std::abs(metres - 1) <= 1e-9;
}

/// The height axis that a CRS itself implies.
HeightAxis axis_of(const Crs& crs) {
  HeightAxis axis = crs.heights.value_or(HeightAxis{});
  if (crs.heights || !crs.metres_per_axis || is_metre(*crs.metres_per_axis)) return axis;
  axis.metres = *crs.metres_per_axis;
  axis.unit = unit_name(axis.metres, "unnamed unit");
  return axis;
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

/// Returns the CRS with the axis, as WKT 2.
std::string with_axis(const Crs& crs, const HeightAxis& axis) {
  return fmt::format(
      "COMPOUNDCRS[{},{},VERTCRS[\"heights\",VDATUM[{}],CS[vertical,1],AXIS[{}],LENGTHUNIT[{},{:.17g}]]]",
      quoted(crs.name + " with heights"), crs.wkt, quoted(axis.datum.empty() ? "unknown" : axis.datum),
      axis.down ? "\"depth (D)\",down" : "\"gravity-related height (H)\",up", quoted(axis.unit), axis.metres);
}

std::string warning_about(const std::string& path, const HeightAxis& axis, const Crs& crs, bool stated) {
  if (!stated && !is_metre(axis.metres))
    return fmt::format(
        "{}: the unit of heights is not stated; taken as that of the coordinates, {:.9g} m. If they are in metres, "
        "give `crs` a compound CRS, such as {}+5703",
        path, axis.metres, crs.name);
  if (axis.down)
    return fmt::format("{}: heights are depths, in units of {:.9g} m, and were converted to heights in metres", path,
                       axis.metres);
  if (is_metre(axis.metres)) return {};
  return fmt::format("{}: heights are in units of {:.9g} m, and were converted to metres", path, axis.metres);
}

}  // namespace

SourceHeights source_heights(const std::string& path, const std::optional<LinearUnit>& stated, const Crs& crs) {
  SourceHeights heights{axis_of(crs), crs.whole, ""};
  if (stated && !crs.heights_given) heights.axis.unit = stated->name, heights.axis.metres = stated->metres;
  heights.warning = warning_about(path, heights.axis, crs, stated || crs.heights);
  if (axis_of(parse_crs(crs.whole, path)) != heights.axis) heights.crs = with_axis(crs, heights.axis);
  return heights;
}

std::string unit_text(const HeightAxis& axis) {
  return axis.metres == 1 ? axis.unit : fmt::format("{} ({:.9g} m)", axis.unit, axis.metres);
}

std::string described(const HeightAxis& axis) {
  return fmt::format("{} {}, unit: {}", axis.down ? "depths below" : "heights above",
                     axis.datum.empty() ? "a datum that is not stated" : axis.datum, unit_text(axis));
}

HeightAxis height_axis(const std::string& crs) {
  return axis_of(parse_crs(crs, "CRS"));
}

}  // namespace itin
