#include "viewshed/viewshed_targets.hpp"

#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster.hpp>

#include "options/half_posting.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

std::optional<viewshed::AngleRange> parse_angles(std::string_view option, const std::string& text, double least,
                                                 double most) {
  if (text.empty()) return std::nullopt;
  const std::vector<double> v = parse_tuple(option, text, 2, "from,to");
  for (const double angle : v) {
    if (angle < least || angle > most) {
      throw InputError(fmt::format("{} '{}': expected degrees from {} to {}", option, text, least, most));
    }
  }
  return viewshed::AngleRange{v[0], v[1]};
}

std::optional<viewshed::AngleRange> parse_azimuths(const std::string& text) {
  const auto range = parse_angles("--azimuth", text, -360, 360);
  if (range && range->from == range->to)
    throw InputError(fmt::format("--azimuth '{}': from and to are the same; for the whole circle leave it out", text));
  return range;
}

std::optional<viewshed::AngleRange> parse_elevations(const std::string& text) {
  const auto range = parse_angles("--elevation", text, -90, 90);
  if (range && range->from >= range->to)
    throw InputError(fmt::format("--elevation '{}': expected from,to with from < to", text));
  return range;
}

}  // namespace

void ViewshedTargets::declare(CLI::App& app) {
  begin_group(app, "Targets, field of view and cells");
  app.add_option("--target-height", height_text_, "Height h of the targets, one in every cell (default: 0)")
      ->type_name("METRES");
  app.add_flag("--target-absolute", absolute_,
               "Heights of targets alone are elevations, not heights above the surface");
  app.add_option("--target-on", on_, "ground (default), or the surface with the roofs and tops of --themes")
      ->type_name("ground|surface");
  app.add_option("--radius", radius_text_, "How far to look (default: as far as there is ground)")->type_name("METRES");
  app.add_option("--min-radius", min_radius_text_, "Leave out what is nearer (default: 0)")->type_name("METRES");
  app.add_option("--azimuth", azimuth_text_, "The field of view, degrees clockwise from grid north")
      ->type_name("FROM,TO");
  app.add_option("--elevation", elevation_text_, "The field of view, degrees above the horizontal")
      ->type_name("FROM,TO");
  app.add_option("--cell", cell_text_,
                 "Size of the raster's cells (default: a round size for at most 2048 cells on a side); unasked they "
                 "are no finer than half the posting of bare ground")
      ->type_name("METRES");
  reads(app.add_option("--like", like_, "Take the cells of this raster")->type_name("FILE"));
}

void ViewshedTargets::validate(const ObserverOptions& observers, viewshed::Request& request) {
  if (!height_text_.empty()) request.target_height = parse_height("--target-height", height_text_);
  const bool stated = height_given() || observers.reads_target_heights();
  if (absolute_ && !stated) throw InputError("--target-absolute: give the elevation of the targets by --target-height");
  absolute_ = absolute_ || observers.absolute_heights();
  request.target_absolute = absolute_ && stated;
  if (!request.target_absolute && request.target_height < 0) {
    throw InputError("--target-height: a height must not be negative; for an elevation give --absolute-heights");
  }
  parse_choice("--target-on", on_, {"ground", "surface"});
  request.targets_on_surface = on_ == "surface";
  request.observers_on_surface = observers.on_surface();
  if (!radius_text_.empty()) request.radius = parse_radius("--radius", radius_text_);
  if (!min_radius_text_.empty()) {
    request.min_radius = parse_number("--min-radius", min_radius_text_, Range::kNotNegative);
  }
  if (request.radius && request.min_radius >= *request.radius) {
    throw InputError("--min-radius: must be less than --radius");
  }
  request.azimuth = parse_azimuths(azimuth_text_);
  request.elevation = parse_elevations(elevation_text_);
  if (!cell_text_.empty() && !like_.empty()) throw InputError("--cell and --like exclude each other");
  if (!cell_text_.empty()) request.cell_size = parse_number("--cell", cell_text_, Range::kPositive);
  if (request.cell_size && request.radius && *request.cell_size > *request.radius) {
    throw InputError(fmt::format("--cell '{}': larger than the radius", cell_text_));
  }
}

void ViewshedTargets::complete(const StoreMetadata& metadata, viewshed::Request& request) const {
  if (!like_.empty()) request.grid = raster_grid_like(like_, metadata.crs_wkt);
  request.finest_default_cell = half_posting(metadata, request.themes);
}

std::string ViewshedTargets::text(const viewshed::Request& request) const {
  if (!absolute_ || request.target_absolute || request.mode == viewshed::Mode::kHeight) return {};
  return "targets stay on the ground: no --target-height gives them an elevation\n";
}

Document ViewshedTargets::parameters(const viewshed::Request& request) const {
  Document parameters;
  parameters[request.target_absolute ? "target_elevation_m" : "target_height_m"] = request.target_height;
  parameters["target_on"] = on_;
  if (request.radius) parameters["radius_m"] = *request.radius;
  if (request.min_radius > 0) parameters["min_radius_m"] = request.min_radius;
  const auto angles = [&](const char* name, const std::optional<viewshed::AngleRange>& range) {
    if (range) parameters[name] = {range->from, range->to};
  };
  angles("azimuth_deg", request.azimuth);
  angles("elevation_deg", request.elevation);
  if (request.cell_size) parameters["cell_m"] = *request.cell_size;
  if (!like_.empty()) parameters["like"] = like_;
  return parameters;
}

}  // namespace itin::cli
