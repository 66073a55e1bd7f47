#include "site/site_rasters.hpp"

#include <fmt/format.h>

#include <itin/raster.hpp>

#include "site/site_wording.hpp"

namespace itin::cli {

void write_site_rasters(const SiteResult& r, const std::string& crs_wkt, const std::string& parameters,
                        bool overwrite) {
  const SiteRasters& rasters = r.rasters;
  const SiteWording wording = wording_of(r.options);
  const bool turbines = r.options.placement.given();
  RasterDescription description;
  description.crs_wkt = crs_wkt;
  description.overwrite = overwrite;
  description.metadata = {{"itin", ITIN_VERSION}, {"parameters", parameters}};
  std::vector<std::uint8_t> served;
  for (const viewshed::Verdict verdict : rasters.served) served.push_back(static_cast<std::uint8_t>(verdict));
  RasterDescription classes = description;
  classes.band_name = turbines ? "seen" : "served";
  classes.nodata = 255;
  classes.classes = {{0, turbines ? wording.unserved : "not served", {225, 225, 225}},
                     {1, turbines ? wording.served : "served", {0, 114, 178}},
                     {255, "beyond the radius, or no data", kTransparent}};
  if (r.coverage.leaves_open()) classes.classes.insert(classes.classes.end() - 1, {2, "undecided", {230, 159, 0}});
  write_raster(r.options.path("coverage.tif"), rasters.grid, std::span<const std::uint8_t>(served), classes);
  description.nodata = SiteRasters::kOutside;
  description.band_name = wording.count;
  write_raster(r.options.path("redundancy.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.redundancy),
               description);
  description.band_name = wording.nearest;
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", i + 1), r.place_of(r.choice.chosen[i]).name);
  for (std::size_t i = 0; i < r.inputs.existing(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", r.choice.chosen.size() + i + 1),
                                      "existing " + r.inputs.positions[r.inputs.options.size() + i].name);
  write_raster(r.options.path("best-server.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.best_server),
               description);
}

}  // namespace itin::cli
