#include <functional>
#include <utility>

#include <fmt/format.h>

#include <itin/parallel.hpp>
#include <itin/raster_regions.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/farm_combinations.hpp"
#include "turbines/output/count_regions.hpp"
#include "turbines/proposal.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

void write_bands(const std::string& path, const std::string& layer, const Zone& zone, const CountClasses& counts,
                 const ZoneFileOptions& options) {
  const RegionLayer bands = band_layer(layer, zone, counts);
  write_regions(path, zone.grid, std::span<const std::uint8_t>(bands.values),
                {options.crs_wkt, layer, bands.classes, true});
}

void write_farm_polygons(const std::string& path, const Zone& zone, const std::vector<std::uint32_t>& farms,
                         const ZoneFileOptions& options) {
  RegionDescription description{options.crs_wkt, "farms", {}, true};
  for (const Combination& c : combinations_present(zone, {&farms}))
    if (c.farms != 0) description.classes.push_back({c.farms, c.name, distinct_colour(description.classes.size())});
  write_regions(path, zone.grid, std::span<const std::uint32_t>(farms), description);
}

void write_addition_polygons(const std::string& path, const Zone& zone, const Visibility& seen,
                             const ZoneFileOptions& options) {
  RegionDescription description{options.crs_wkt, "additional", {}, true};
  for (std::size_t i = 1; i < kAdditions.size(); ++i)
    description.classes.push_back({static_cast<std::uint32_t>(i), kAdditions[i].text, kAdditions[i].colour});
  write_regions(path, zone.grid, std::span<const std::uint8_t>(additions(zone, seen)), description);
}

/// A file that does not depend on the others.
struct PolygonFile {
  ZoneFile file;
  std::function<void(const std::string& path)> write;
};

/// Adds the files of what is seen. Both the zone and the options must outlive them.
void add_files(const Zone& zone, const Visibility& seen, const std::string& suffix, const ZoneFileOptions& options,
               std::vector<PolygonFile>& files) {
  const std::string undecided =
      zone.leaves_open() ? "; the class undecided is where ground without data leaves open whether any is" : "";
  const std::string hubs = known_hubs(zone) < zone.request.turbines.size() ? ", hubs" + of_known_hubs(zone) : "";
  files.push_back(
      {{"tip-count" + suffix + ".gpkg",
        "polygons of the areas from which tips are seen, by bands of their number, with the area in m²" + undecided},
       [&](const std::string& path) {
         write_bands(path, "tip-count", zone, {zone, seen, TurbinePart::kTip}, options);
       }});
  if (known_hubs(zone) > 0)
    files.push_back({{"hub-count" + suffix + ".gpkg",
                      "where a band of turbines has its hubs seen" + hubs + ": polygons, m²" + undecided},
                     [&](const std::string& path) {
                       write_bands(path, "hub-count", zone, {zone, seen, TurbinePart::kHub}, options);
                     }});
  if (has_proposal(zone.request))
    files.push_back(
        {{"additional" + suffix + ".gpkg", "where the proposal, other turbines or both have tips seen: polygons, m²"},
         [&](const std::string& path) { write_addition_polygons(path, zone, seen, options); }});
  if (farms_of(zone.request.turbines).size() < 2) return;
  files.push_back(
      {{"farms" + suffix + ".gpkg", "where a combination of farms has tips seen: polygons, m²"},
       [&](const std::string& path) { write_farm_polygons(path, zone, farm_combinations(zone, seen), options); }});
}

/// Adds the files of what is seen through woods in a season. Both the zone and the options must outlive them.
void add_season_files(const Zone& zone, const SeasonCounts& counts, const std::string& season,
                      const ZoneFileOptions& options, std::vector<PolygonFile>& files) {
  const auto add = [&](const std::string& part, TurbinePart which, const std::string& of) {
    files.push_back(
        {{fmt::format("{}-count-{}.gpkg", part, season),
          fmt::format("where a band of turbines has its {} seen through woods in {}: polygons, m²", of, season)},
         [&, part, which](const std::string& path) {
           write_bands(path, part + "-count", zone, {zone, counts, which}, options);
         }});
  };
  add("tip", TurbinePart::kTip, "tips");
  if (known_hubs(zone) > 0) add("hub", TurbinePart::kHub, "hubs" + of_known_hubs(zone));
}

}  // namespace

std::vector<ZoneFile> write_zone_polygons(const std::string& folder, const Zone& zone, const ZoneFileOptions& options) {
  std::vector<PolygonFile> files;
  add_files(zone, zone.bare, "", options, files);
  if (zone.screened) add_files(zone, *zone.screened, "-screened", options, files);
  if (zone.seasons) {
    add_season_files(zone, zone.seasons->summer, "summer", options, files);
    add_season_files(zone, zone.seasons->winter, "winter", options, files);
  }
  parallel_for(files.size(), [&](std::size_t i) { files[i].write(folder + "/" + files[i].file.name); });
  std::vector<ZoneFile> written;
  for (PolygonFile& f : files) written.push_back(std::move(f.file));
  return written;
}

}  // namespace itin::viewshed
