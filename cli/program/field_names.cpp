#include "program/field_names.hpp"

#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace itin::cli {

namespace {

using Names = std::pair<std::string_view, std::string_view>;

constexpr std::array kNames{
    Names{"allow_mixed_vertical", "--allow-mixed-vertical"},
    Names{"allow_network", "--allow-network"},
    Names{"alone", "--wireline-pairs"},
    Names{"antenna_azimuth", "--antenna-azimuth"},
    Names{"antenna_tilt", "--antenna-tilt"},
    Names{"attributes", "--attributes"},
    Names{"azimuth", "--azimuth"},
    Names{"band", "--band"},
    Names{"base", "--base"},
    Names{"base_field", "--base-field"},
    Names{"blade_width", "--blade-width"},
    Names{"budget", "--budget"},
    Names{"cell_size", "--cell"},
    Names{"classes", "--class"},
    Names{"compatible", "the spacing (--rotor-spacing, --min-spacing)"},
    Names{"count", "--count"},
    Names{"cover", "--k-cover"},
    Names{"crs", "--crs"},
    Names{"dwelling_theme", "--dwelling-theme"},
    Names{"dwellings", "--dwellings"},
    Names{"eaves_field", "--eaves-field"},
    Names{"eirp_dbm", "--eirp-dbm"},
    Names{"extinction", "--foliage"},
    Names{"eye_height", "--observer-height"},
    Names{"feeder_loss_db", "--feeder-loss-db"},
    Names{"foliage", "--foliage"},
    Names{"foundation", "--foundation"},
    Names{"frequency_ghz", "--frequency"},
    Names{"fresnel", "--fresnel"},
    Names{"from", "--from"},
    Names{"from_antenna", "--from-antenna"},
    Names{"from_is_elevation", "--observer-absolute"},
    Names{"gain_dbi", "--gain-dbi"},
    Names{"geoclimatic_factor", "--geoclimatic-factor"},
    Names{"height", "--height"},
    Names{"height_field", "--height-field"},
    Names{"height_from", "--height-from"},
    Names{"height_percentile", "--height-percentile"},
    Names{"height_rounding", "--height-rounding"},
    Names{"height_step", "--height-step"},
    Names{"height_threshold", "--height-threshold"},
    Names{"hub", "--hub"},
    Names{"hub_height_field", "--hub-height-field"},
    Names{"id_field", "--id-field"},
    Names{"in_crs", "--in-crs"},
    Names{"kind", "--kind"},
    Names{"layer", "--layer"},
    Names{"leaf_area", "--leaf-area"},
    Names{"least_elevation_deg", "--sun-elevation"},
    Names{"least_transmittance", "--transmittance"},
    Names{"margin_db", "--margin-db"},
    Names{"margins_db", "--margin-db"},
    Names{"masts", "--masts"},
    Names{"max_gap", "--max-gap"},
    Names{"memory_bytes", "--memory"},
    Names{"months", "--months"},
    Names{"name_field", "--name-field"},
    Names{"nodata", "--nodata"},
    Names{"on_surface", "--observer-on surface"},
    Names{"output", "-o"},
    Names{"overwrite", "--overwrite"},
    Names{"poles", "--pole"},
    Names{"power_dbm", "--power-dbm"},
    Names{"proposal", "--proposal"},
    Names{"radius", "--radius"},
    Names{"radius_rule", "--radius-preset"},
    Names{"rays", "--rays"},
    Names{"rain_rate_mm_h", "--rain-rate-mm-h"},
    Names{"reach_diameters", "--flicker-reach"},
    Names{"refractivity_gradient", "--refractivity-gradient"},
    Names{"repair = false", "--no-repair"},
    Names{"remove", "--remove"},
    Names{"replace", "--replace"},
    Names{"report", "--report"},
    Names{"resolution", "--resolution"},
    Names{"reveal", "--reveal"},
    Names{"roof", "--roof"},
    Names{"rotor_diameter_field", "--rotor-diameter-field"},
    Names{"route_step", "--every"},
    Names{"scale", "--sheet-scale"},
    Names{"sea_area", "--sea-area"},
    Names{"sea_level", "--sea-level"},
    Names{"sensitivity_dbm", "--sensitivity-dbm"},
    Names{"setback", "--setback"},
    Names{"sheets_of", "--sheets-of"},
    Names{"spacing", "--spacing"},
    Names{"stay", "--stay"},
    Names{"storey", "--storey"},
    Names{"table_spacing_m", "--table-spacing"},
    Names{"target_height", "--target-height"},
    Names{"targets", "--targets"},
    Names{"theme", "--theme"},
    Names{"themes", "--themes"},
    Names{"thickness", "--thickness"},
    Names{"tip_height_field", "--tip-height-field"},
    Names{"to", "--to"},
    Names{"to_antenna", "--to-antenna"},
    Names{"to_crs", "--to-crs"},
    Names{"to_is_elevation", "--target-absolute"},
    Names{"tolerance", "--tolerance"},
    Names{"tolerances", "--levels"},
    Names{"turbines", "--turbines"},
    Names{"utc_offset_minutes", "--time-zone"},
    Names{"wall_offset", "--wall-offset"},
    Names{"where", "--where"},
    Names{"wirelines", "--wirelines"},
    Names{"without", "--without"},
    Names{"year", "--year"},
    Names{"z_field", "--z-field"},
};

}  // namespace

std::string in_options(std::string message) {
  for (const auto& [field, option] : kNames) {
    const std::string quoted = fmt::format("`{}`", field);
    for (std::size_t at = message.find(quoted); at != std::string::npos; at = message.find(quoted, at + option.size()))
      message.replace(at, quoted.size(), option);
  }
  return message;
}

}  // namespace itin::cli
