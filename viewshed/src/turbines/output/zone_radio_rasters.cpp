#include <fmt/format.h>

#include <viewshed/link_exclusion.hpp>
#include <viewshed/zone_files.hpp>

#include "turbines/output/raster_folder.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

std::vector<ZoneFile> write_radar_raster(const std::string& folder, const Zone& zone, const ZoneFileOptions& options) {
  RasterFolder files(folder, zone, options);
  const auto write = [&](const char* name, const std::string& what, const std::vector<float>& heights) {
    files.write(name, what, heights, with_nodata(kNaN), banded_style(radar_bands()));
  };
  if (!zone.radar) return {};
  const bool open = zone.radar->leaves_open();
  write("radar-height",
        std::string("least height above the ground that the radar sees over bare ground, metres; NaN: above 1000 m, or "
                    "no ground") +
            (open ? ", or undecided: see radar-height-undecided.tif" : ""),
        zone.radar->height_m);
  // A turbine that is to stay out of a radar's sight must stay below this height, too.
  if (open)
    write("radar-height-undecided",
          "least height above the ground that the radar may see, where ground without data alone leaves open whether "
          "it does, metres; NaN: it is known",
          zone.radar->undecided_height_m);
  return std::move(files).files();
}

std::vector<ZoneFile> write_link_raster(const std::string& folder, const Zone& zone, const ZoneFileOptions& options,
                                        const LinkStudy& study) {
  RasterFolder files(folder, zone, options);
  if (study.links.empty()) return {};
  RasterDescription description;
  description.classes = {{kLinkClear, "clear of links", kTransparent},
                         {kLinkExcluded, "rotor within a second Fresnel zone", {213, 94, 0}}};
  files.write(
      "link-exclusion",
      fmt::format("1 where a rotor of radius {:g} m would come into the second Fresnel zone of a link at {:g} GHz "
                  "in plan (after Bacon 2002), otherwise 0",
                  study.rotor_radius_m, study.frequency_ghz),
      link_exclusion(zone.grid, study.links, study.frequency_ghz, study.rotor_radius_m), description,
      class_style(description.classes));
  return std::move(files).files();
}

}  // namespace itin::viewshed
