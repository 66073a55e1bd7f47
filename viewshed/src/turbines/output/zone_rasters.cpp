#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/parallel.hpp>
#include <profile/foliage.hpp>
#include <viewshed/missing_ground.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/farm_combinations.hpp"
#include "turbines/output/count_classes.hpp"
#include "turbines/output/raster_folder.hpp"
#include "turbines/proposal.hpp"
#include "turbines/value_bands.hpp"
#include "turbines/zone_cells.hpp"

namespace itin::viewshed {

namespace {

/// A quantity that is a raster of floats.
struct Quantity {
  const char* name;
  ZoneQuantity values;
  const char* what;
  const char* unit;
  std::vector<double> limits;  ///< upper ends of its bands
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> kQuantities{
      {"visible-height",
       &Visibility::visible_height_m,
       "tip height less the least visible height, metres, of the turbine with the greatest; 0 where none is seen",
       "m",
       {10, 25, 50, 75, 100, 150}},
      {"vertical-angle",
       &Visibility::vertical_angle_deg,
       "vertical angle that the visible part of a turbine takes up, degrees, the greatest of the turbines",
       "deg",
       {0.1, 0.25, 0.5, 1, 2, 5}},
      {"vertical-angle-sum",
       &Visibility::vertical_angle_sum_deg,
       "vertical angles of all turbines' visible parts, degrees, summed",
       "deg",
       {0.5, 1, 2.5, 5, 10, 25}},
      {"horizontal-angle",
       &Visibility::horizontal_angle_deg,
       "smallest horizontal angle that holds every visible turbine's rotor, degrees; 0 where none is seen",
       "deg",
       {1, 2.5, 5, 10, 20, 45}},
      {"horizontal-from",
       &Visibility::horizontal_from_deg,
       "azimuth from grid north, degrees, at which that angle begins, clockwise; no value where none is seen",
       "deg",
       {45, 90, 135, 180, 225, 270, 315}},
      {"horizontal-occupied",
       &Visibility::horizontal_occupied_deg,
       "the part of that angle that rotors themselves take up, degrees",
       "deg",
       {0.5, 1, 2.5, 5, 10, 20}},
      {"share",
       &Visibility::share,
       "turbines with their tip seen, as a share of all turbines, 0 to 1",
       "of all",
       {0.1, 0.25, 0.5, 0.75, 0.9}},
      {"nearest",
       &Visibility::nearest_m,
       "horizontal distance to the nearest turbine with its tip seen, metres; no value where none is seen",
       "m",
       {1000, 2500, 5000, 10000, 20000, 30000, 40000}},
  };
  return kQuantities;
}

/// The visibility over one of the zone's surfaces.
struct View {
  const Visibility& seen;
  std::string suffix;  ///< ends the names of its rasters
  std::string remark;  ///< a remark added to the description of each raster
};

View view_over(const Zone& zone, const Visibility& seen, const std::string& suffix) {
  if (!zone.leaves_open()) return {seen, suffix, ""};
  return {seen, suffix,
          fmt::format("; what is certainly seen: undecided{}.tif tells what ground without data leaves open", suffix)};
}

/// Returns "hub", and where some are not known, whose hubs count.
std::string hub_in_words(const Zone& zone) {
  const std::string known = of_known_hubs(zone);
  return known.empty() ? "hub" : fmt::format("hub (hubs{}, the others are not known)", known);
}

void write_counts(const Zone& zone, const View& view, RasterFolder& folder) {
  const auto write = [&](const std::string& name, TurbinePart part, const std::string& what,
                         const std::vector<std::uint16_t>& counts) {
    folder.write(name + view.suffix, what, counts, with_nodata(kCountOutside), banded_style(count_bands(zone, part)));
  };
  const auto what = [&](const std::string& part) {
    return fmt::format("how many turbines have their {} seen; 65535: {}{}", part, kNoValue, view.remark);
  };
  const std::string hub = hub_in_words(zone);
  if (known_hubs(zone) > 0) write("hub-count", TurbinePart::kHub, what(hub), view.seen.hub_count);
  write("tip-count", TurbinePart::kTip, what("tip"), view.seen.tip_count);
  if (!zone.leaves_open()) return;
  const auto undecided = [](const std::string& part) {
    return fmt::format(
        "how many turbines more have their {} seen, or not: ground without data alone leaves it open; 65535: {}", part,
        kNoValue);
  };
  if (known_hubs(zone) > 0) write("undecided-hubs", TurbinePart::kHub, undecided(hub), view.seen.hub_undecided);
  write("undecided", TurbinePart::kTip, undecided("tip"), view.seen.tip_undecided);
}

/// Writes how many turbines are seen through woods, in leaf and in winter.
void write_seasons(const Zone& zone, RasterFolder& folder) {
  const auto write = [&](const std::string& season, const SeasonCounts& counts, double leaf_area) {
    const auto one = [&](const char* name, TurbinePart part, const std::string& of,
                         const std::vector<std::uint16_t>& values) {
      folder.write(fmt::format("{}-count-{}", name, season),
                   fmt::format("how many turbines have their {} seen through woods in {} (leaf area {:g} m²/m³, "
                               "extinction {:g}, {:g} % of the light are enough); 65535: {}",
                               of, season, leaf_area, zone.request.foliage->extinction,
                               100 * zone.request.foliage->least_transmittance, kNoValue),
                   values, with_nodata(kCountOutside), banded_style(count_bands(zone, part)));
    };
    if (known_hubs(zone) > 0) one("hub", TurbinePart::kHub, hub_in_words(zone), counts.hub_count);
    one("tip", TurbinePart::kTip, "tip", counts.tip_count);
  };
  write("summer", zone.seasons->summer, profile::kLeavesOn);
  write("winter", zone.seasons->winter, profile::kLeavesOff);
}

/// Returns a style that shows whether any of the first 32 turbines is seen. QGIS's identify tool tells which ones.
std::string seen_style() {
  return banded_style(
      {{0, "none", kTransparent}, {4294967295.0, "some turbine of the first 32 seen", distinct_colour(3)}});
}

void write_bits(const Zone& zone, const View& view, RasterFolder& folder) {
  RasterDescription description;
  const auto name = [](std::size_t word) { return fmt::format("turbines {} to {}", 32 * word + 1, 32 * word + 32); };
  description.band_name = name(0);
  for (std::size_t w = 1; w < zone.words; ++w) description.further_bands.push_back(name(w));
  folder.write_parts<std::uint32_t>(
      "turbines" + view.suffix,
      "which turbines have their tip seen: turbine k of the file is bit k - 1, 32 turbines in each band; no nodata "
      "value, 0 where none is seen" +
          view.remark,
      [&](const Zone& part) -> const auto& { return of_same_surface(zone, view.seen, part).turbines; }, description,
      seen_style());
}

void write_quantities(const Zone& zone, const View& view, RasterFolder& folder) {
  for (const Quantity& q : quantities())
    folder.write_parts<float>(
        q.name + view.suffix, fmt::format("{}; NaN: {}{}", q.what, kNoValue, view.remark),
        [&](const Zone& part) -> const auto& { return of_same_surface(zone, view.seen, part).*q.values; },
        with_nodata(kNaN), banded_style(limit_bands(q.limits, q.unit)));
}

/// Returns bare less screened. Where either has no value the difference has none: 65535 less 65535 must not become 0.
template <class T>
std::vector<float> difference(const std::vector<T>& bare, const std::vector<T>& screened, T none) {
  std::vector<float> result(bare.size());
  for (std::size_t i = 0; i < bare.size(); ++i)
    result[i] = bare[i] == none || screened[i] == none ? std::numeric_limits<float>::quiet_NaN()
                                                       : static_cast<float>(bare[i]) - static_cast<float>(screened[i]);
  return result;
}

void write_differences(const Zone& zone, RasterFolder& folder) {
  const auto what = [](const std::string& of) {
    return fmt::format("{}: bare ground less screened; NaN: {}", of, kNoValue);
  };
  const Visibility &bare = zone.bare, &screened = *zone.screened;
  if (known_hubs(zone) > 0)
    folder.write("hub-count-difference", what(fmt::format("hubs{} seen", of_known_hubs(zone))),
                 difference(bare.hub_count, screened.hub_count, kCountOutside), with_nodata(kNaN),
                 banded_style(count_bands(zone, TurbinePart::kHub)));
  folder.write("tip-count-difference", what("tips seen"), difference(bare.tip_count, screened.tip_count, kCountOutside),
               with_nodata(kNaN), banded_style(count_bands(zone, TurbinePart::kTip)));
  for (const Quantity& q : quantities()) {
    // The difference of azimuths means nothing, nor does that of distances of which one may be missing.
    if (q.values == &Visibility::horizontal_from_deg || q.values == &Visibility::nearest_m) continue;
    folder.write_parts<float>(
        fmt::format("{}-difference", q.name), what(q.what),
        [&](const Zone& part) {
          return difference(part.bare.*q.values, (*part.screened).*q.values, std::numeric_limits<float>::quiet_NaN());
        },
        with_nodata(kNaN), banded_style(limit_bands(q.limits, q.unit)));
  }
}

std::string style_of_combinations(const std::vector<std::uint32_t>& farms, const std::vector<Combination>& present) {
  std::vector<StyleClass> classes;
  for (const Combination& c : commonest_first(present, cells_by_combination(farms)))
    if (c.farms != 0) classes.push_back({c.farms, c.name});
  return commonest_style(std::move(classes));
}

/// Writes the raster of farms. Up to seven farms are classes of a Byte raster, with names and colours; the combinations
/// of more farms are numbers, whose names farms.csv has.
void write_farm_raster(const std::vector<std::uint32_t>& farms, const std::vector<Combination>& present,
                       std::size_t farm_count, const View& view, RasterFolder& folder) {
  const std::string name = "farms" + view.suffix;
  constexpr std::size_t kClasses = 7;
  if (farm_count > kClasses) {
    const std::string what =
        farm_count <= kMostFarms
            ? "which farms have a tip seen: farm f of the list is bit f - 1; farms.csv has the names, the "
              "style colours the commonest; 4294967295: no value"
            : "which farms have a tip seen: the number of their combination in farms.csv; the style "
              "colours the commonest; 4294967295: no value";
    folder.write(name, what + view.remark, farms, with_nodata(kOutsideFarms), style_of_combinations(farms, present));
    return;
  }
  constexpr std::uint8_t kOutsideClass = 255;
  RasterDescription description = with_nodata(kOutsideClass);
  std::size_t index = 0;
  for (const Combination& c : present) {
    const Rgba colour = c.farms == 0 ? kTransparent : distinct_colour(index++);
    description.classes.push_back({static_cast<int>(c.farms), c.name, colour});
  }
  std::vector<std::uint8_t> classes(farms.size());
  std::transform(farms.begin(), farms.end(), classes.begin(),
                 [](std::uint32_t f) { return f == kOutsideFarms ? kOutsideClass : static_cast<std::uint8_t>(f); });
  folder.write(name, fmt::format("which farms have a tip seen, by combination; 255: {}{}", kNoValue, view.remark),
               classes, description, class_style(description.classes));
}

void write_farm_rasters(const Zone& zone, const std::vector<View>& views, RasterFolder& folder) {
  const std::size_t count = farms_of(zone.request.turbines).size();
  if (count < 2) return;
  const std::vector<std::uint32_t> bare = farm_combinations(zone, zone.bare);
  std::vector<std::uint32_t> screened;
  if (zone.screened) screened = farm_combinations(zone, *zone.screened);
  const auto present = combinations_present(zone, {&bare, &screened});
  write_farm_raster(bare, present, count, views.front(), folder);
  if (zone.screened) write_farm_raster(screened, present, count, views.back(), folder);
}

/// Writes what of the zone is the proposal's own, and what it adds to the others.
void write_proposal(const Zone& zone, const View& view, RasterFolder& folder) {
  folder.write("proposal-tip-count" + view.suffix,
               fmt::format("how many proposed turbines have their tip seen; 65535: {}{}", kNoValue, view.remark),
               proposed_tips(zone, view.seen), with_nodata(kCountOutside),
               banded_style(count_bands(proposed_turbines(zone.request.turbines), zone.request.count_bands)));
  RasterDescription description = with_nodata(kNoAddition);
  for (std::size_t i = 0; i < kAdditions.size(); ++i)
    description.classes.push_back({static_cast<int>(i), kAdditions[i].text, kAdditions[i].colour});
  folder.write(
      "additional" + view.suffix,
      fmt::format("whether the proposal, other turbines or both have a tip seen; 255: {}{}", kNoValue, view.remark),
      additions(zone, view.seen), description, class_style(description.classes));
}

/// Writes the study area, since cells without a value in the other rasters may lie outside it or have no ground.
void write_study_area(const Zone& zone, RasterFolder& folder) {
  constexpr std::uint8_t kNoGround = 0, kGround = 1, kOutsideStudy = 255;
  const std::vector<std::uint8_t> missing = cells_without_ground(zone);
  std::vector<std::uint8_t> values(missing.size(), kOutsideStudy);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (missing[i] == 1 || zone.bare.tip_count[i] != kCountOutside) values[i] = missing[i] == 1 ? kNoGround : kGround;
  RasterDescription description = with_nodata(kOutsideStudy);
  description.classes = {{kNoGround, "no ground data", {120, 120, 120}}, {kGround, "studied", kTransparent}};
  folder.write("study-area",
               "1 where turbines are looked for, 0 where there is no ground data; 255: outside every turbine's radius",
               values, description, class_style(description.classes));
}

}  // namespace

std::vector<ZoneFile> write_zone_rasters(const std::string& folder, const Zone& zone, const ZoneFileOptions& options) {
  RasterFolder files(folder, zone, options);
  std::vector<View> views{view_over(zone, zone.bare, "")};
  if (zone.screened) views.push_back(view_over(zone, *zone.screened, "-screened"));
  for (const View& view : views) {
    write_counts(zone, view, files);
    write_bits(zone, view, files);
    write_quantities(zone, view, files);
  }
  if (zone.screened) write_differences(zone, files);
  if (zone.seasons) write_seasons(zone, files);
  write_farm_rasters(zone, views, files);
  if (has_proposal(zone.request))
    for (const View& view : views) write_proposal(zone, view, files);
  write_study_area(zone, files);
  return std::move(files).files();
}

}  // namespace itin::viewshed
