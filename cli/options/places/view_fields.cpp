#include "options/places/view_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/height_limit.hpp>

#include "program/values.hpp"

namespace itin::cli {

namespace {

/// Throws InputError where nothing can be in view.
void require_view(const viewshed::Observer& observer, const std::string& where) {
  const auto refuse = [&](const char* what, const viewshed::AngleRange& angles, const char* advice) {
    throw InputError(fmt::format("{}: its {} run from {:g} to {:g}: {}", where, what, angles.from, angles.to, advice));
  };
  if (observer.elevation && observer.elevation->from >= observer.elevation->to)
    refuse("elevations", *observer.elevation, "give a lower and then a higher one");
  if (observer.azimuth && observer.azimuth->from == observer.azimuth->to)
    refuse("azimuths", *observer.azimuth, "for the whole circle leave them empty");
}

/// The value of a field for one observer.
struct FieldValue {
  const std::string& where;
  const std::string& field;
  double value = 0;

  [[noreturn]] void refuse(const std::string& expected) const {
    throw InputError(fmt::format("{}: field '{}' holds {:.10g}: expected {}", where, field, value, expected));
  }
  /// Returns the value, a height or an elevation, if it is valid.
  double elevation() const {
    require_height(value, fmt::format("{}: field '{}'", where, field));
    return value;
  }
  /// Returns `metres`, which the value stands for, if it is a valid distance.
  double distance(double metres) const {
    if (metres > kFarthest) refuse(fmt::format("at most {:.0f} metres", kFarthest));
    if (metres < 0) refuse("0 or a positive number of metres");
    return metres;
  }
  /// Returns the value if it is from -most to most.
  double angle(int most) const {
    if (std::abs(value) > most) refuse(fmt::format("degrees from {} to {}", -most, most));
    return value;
  }
};

/// Returns the range, made from `all` if there is none yet: where one end is given, the range is open at the other.
viewshed::AngleRange& range_of(std::optional<viewshed::AngleRange>& angles, viewshed::AngleRange all) {
  return angles ? *angles : angles.emplace(all);
}

}  // namespace

void ViewFields::declare(CLI::App& app) {
  const auto field = [&](const char* option, std::string& to, const char* help, const char* type) {
    app.add_option(option, to, help)->type_name(type);
  };
  field("--target-height-field", target_height_, "The field of the --observers file that holds --target-height",
        "FIELD");
  field("--radius-field", radius_, "The field that holds --radius", "FIELD");
  field("--min-radius-field", min_radius_, "The field that holds --min-radius", "FIELD");
  field("--azimuth-fields", azimuths_, "The fields that hold --azimuth", "FROM,TO");
  field("--elevation-fields", elevations_, "The fields that hold --elevation", "FROM,TO");
  app.add_flag("--arcgis-fields", arcgis_,
               "Take whichever of OFFSETA, OFFSETB, SPOT, AZIMUTH1, AZIMUTH2, VERT1, VERT2, RADIUS1, RADIUS2 the file "
               "has; radii are horizontal, whatever their sign");
}

std::string ViewFields::text_given() const {
  return target_height_ + radius_ + min_radius_ + azimuths_ + elevations_ + (arcgis_ ? "arcgis" : "");
}

void ViewFields::add_pair(const char* option, const std::string& text, Role from, Role to) {
  if (text.empty()) return;
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size())
    throw InputError(fmt::format("{} '{}': expected two fields, FROM,TO", option, text));
  fields_.push_back({from, text.substr(0, comma)});
  fields_.push_back({to, text.substr(comma + 1)});
}

void ViewFields::validate() {
  if (arcgis_) {
    if (text_given() != "arcgis")
      throw InputError("--arcgis-fields names all fields; leave out the options that name single ones");
    using enum Role;
    // VERT1 is the upper limit.
    fields_ = {{kHeight, "OFFSETA"},     {kSpot, "SPOT"},           {kTargetHeight, "OFFSETB"},
               {kMinRadius, "RADIUS1"},  {kRadius, "RADIUS2"},      {kAzimuthFrom, "AZIMUTH1"},
               {kAzimuthTo, "AZIMUTH2"}, {kElevationFrom, "VERT2"}, {kElevationTo, "VERT1"}};
    return;
  }
  if (!target_height_.empty()) fields_.push_back({Role::kTargetHeight, target_height_});
  if (!radius_.empty()) fields_.push_back({Role::kRadius, radius_});
  if (!min_radius_.empty()) fields_.push_back({Role::kMinRadius, min_radius_});
  add_pair("--azimuth-fields", azimuths_, Role::kAzimuthFrom, Role::kAzimuthTo);
  add_pair("--elevation-fields", elevations_, Role::kElevationFrom, Role::kElevationTo);
}

std::vector<NumberField> ViewFields::numbers() const {
  std::vector<NumberField> numbers;
  for (const Field& field : fields_) numbers.push_back({field.name, !arcgis_});
  return numbers;
}

void ViewFields::fill(viewshed::Observer& observer, const std::vector<std::optional<double>>& numbers,
                      const std::string& where) const {
  std::optional<double> spot;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (!numbers[i]) continue;
    const double value = *numbers[i];
    // ArcGIS writes horizontal distances with a minus sign.
    const double metres = arcgis_ ? std::abs(value) : value;
    const FieldValue field{where, fields_[i].name, value};
    switch (fields_[i].role) {
      case Role::kHeight:
        observer.height = field.elevation();
        if (value < 0) field.refuse("0 or a positive number of metres");
        break;
      case Role::kSpot:
        spot = field.elevation();
        break;
      case Role::kTargetHeight:
        observer.target_height = field.elevation();
        break;
      case Role::kRadius:
        if (!(metres > 0)) field.refuse("a positive number of metres");
        observer.radius = field.distance(metres);
        break;
      case Role::kMinRadius:
        observer.min_radius = field.distance(metres);
        break;
      case Role::kAzimuthFrom:
        range_of(observer.azimuth, {0, 360}).from = field.angle(360);
        break;
      case Role::kAzimuthTo:
        range_of(observer.azimuth, {0, 360}).to = field.angle(360);
        break;
      case Role::kElevationFrom:
        range_of(observer.elevation, {-90, 90}).from = field.angle(90);
        break;
      case Role::kElevationTo:
        range_of(observer.elevation, {-90, 90}).to = field.angle(90);
        break;
    }
  }
  if (spot) observer.height += *spot, observer.absolute = true;
  require_view(observer, where);
}

std::string ViewFields::source_of(Role role, bool is_own, const char* option) const {
  const auto field = std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.role == role; });
  return is_own && field != fields_.end() ? fmt::format("field '{}'", field->name) : option;
}

void ViewFields::require_agreement(const viewshed::Observer& observer, const viewshed::Request& request,
                                   const std::string& where) const {
  if (observer.target_height.value_or(0) < 0 && !request.target_absolute)
    throw InputError(
        fmt::format("{}: its target height of {:.10g} m ({}) is negative; for elevations give --absolute-heights",
                    where, *observer.target_height, source_of(Role::kTargetHeight, true, "")));
  const std::optional<double> radius = observer.radius ? observer.radius : request.radius;
  if (!radius) return;
  const std::string radius_source = source_of(Role::kRadius, observer.radius.has_value(), "--radius");
  const double least = observer.min_radius.value_or(request.min_radius);
  if (least > *radius && (observer.radius || observer.min_radius))
    throw InputError(fmt::format(
        "{}: its least radius of {:.10g} m ({}) exceeds its radius of {:.10g} m ({}): correct one of them", where,
        least, source_of(Role::kMinRadius, observer.min_radius.has_value(), "--min-radius"), *radius, radius_source));
  const double cell =
      request.grid ? std::max(request.grid->cell_width(), request.grid->cell_height()) : request.cell_size.value_or(0);
  if (cell > *radius && observer.radius)
    throw InputError(fmt::format(
        "{}: its radius of {:.10g} m ({}) is smaller than a cell of {:.10g} m ({}): give smaller cells, or correct it",
        where, *radius, radius_source, cell, request.grid ? "--like" : "--cell"));
}

}  // namespace itin::cli
