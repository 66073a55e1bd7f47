#include "site/site_outputs.hpp"

#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/csv_cell.hpp>
#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <itin/raster.hpp>
#include <itin/vector_export.hpp>

#include "output/store_document.hpp"
#include "site/site_link_outputs.hpp"

namespace itin::cli {

namespace {

std::string place(const std::string& directory, const char* name) {
  return (std::filesystem::path(directory) / name).string();
}

std::string sites_csv(const SiteResult& r) {
  std::string text =
      "order,id,x,y,height_m,ground_m,cost,gain,cumulative,coverage,first_certain,first_possible,stands_on_m\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    const CoverageSummary now = r.summary(r.coverage.bounds(site.option)),
                          first = r.summary(r.coverage.first_bounds(site.option));
    fmt::format_to(out, "{},{},{},{},{},{:.3f},{},{},{},{},{},{},{:.3f}\n", i + 1, csv_cell(place.name),
                   place.position.x, place.position.y, place.height, r.ground_m[i], r.inputs.options[site.option].cost,
                   r.in_metric(site.gain), r.in_metric(site.cumulative), now.certain, first.certain, first.possible,
                   place.ground);
  }
  return text;
}

std::string candidates_table(const SiteResult& r) {
  std::string text =
      "id,x,y,height_m,cost,looked_at,first_certain,first_possible,certain,possible,proposed_as,outcome\n";
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const viewshed::SitePosition& place = r.inputs.positions[i];
    const CoverageSummary now = r.summary(r.coverage.bounds(i)), first = r.summary(r.coverage.first_bounds(i));
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(place.name), place.position.x,
                   place.position.y, place.height, r.inputs.options[i].cost,
                   csv_cell(r.coverage.stage_name(r.coverage.stage(i))), first.certain, first.possible, now.certain,
                   now.possible, r.candidate(i).why, csv_cell(r.reason(i)));
  }
  return text;
}

using Type = VectorLayer::Type;

VectorLayer sites_layer(const SiteResult& r) {
  VectorLayer layer{"sites",
                    VectorLayer::Shape::kPoints,
                    {{"rank", Type::kWhole},
                     {"id", Type::kText},
                     {"height_m", Type::kNumber},
                     {"cost", Type::kNumber},
                     {"gain", Type::kNumber},
                     {"cumulative", Type::kNumber}},
                    {}};
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    layer.features.push_back(
        {{{place.position.x, place.position.y, place.ground}},
         {static_cast<std::int64_t>(i + 1), place.name, place.height, r.inputs.options[site.option].cost,
          r.in_metric(site.gain), r.in_metric(site.cumulative)}});
  }
  return layer;
}

VectorLayer candidates_layer(const SiteResult& r) {
  VectorLayer layer{"candidates",
                    VectorLayer::Shape::kPoints,
                    {{"id", Type::kText},
                     {"height_m", Type::kNumber},
                     {"cost", Type::kNumber},
                     {"looked_at", Type::kText},
                     {"certain", Type::kNumber},
                     {"possible", Type::kNumber},
                     {"outcome", Type::kText}},
                    {}};
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const viewshed::SitePosition& place = r.inputs.positions[i];
    const CoverageSummary now = r.summary(r.coverage.bounds(i));
    layer.features.push_back({{{place.position.x, place.position.y, place.ground}},
                              {place.name, place.height, r.inputs.options[i].cost,
                               r.coverage.stage_name(r.coverage.stage(i)), now.certain, now.possible, r.reason(i)}});
  }
  return layer;
}

Document interval(const CoverageSummary& summary) {
  return Document::array({summary.certain, summary.possible});
}

}  // namespace

std::vector<SiteOutput> site_outputs(const std::string& directory, const SheetOptions& sheets, bool has_hub,
                                     OutputPolicy& policy) {
  std::vector<std::pair<std::string, std::string>> files{
      {"sites.gpkg", "chosen sites, candidates, links between sites"},
      {"sites.csv", "chosen sites in order, with gains and bounds"},
      {"candidates.csv", "every candidate, its bounds and why it is chosen or not"},
      {"links.csv", "lines of sight between chosen sites"},
      {"coverage.tif", "what the choice and existing sites serve"},
      {"redundancy.tif", "how many of them serve a cell"},
      {"best-server.tif", "the nearest site that serves a cell"},
      {"coverage.png", "map of coverage.tif"},
      {"redundancy.png", "map of redundancy.tif"},
      {"report.html", "everything on one page"},
      {"site.json", "the result as a document"},
      {"parameters.json", "for --params: runs this again"}};
  if (has_hub) files.emplace_back("routes.csv", "the route of every site to the hub, hop by hop");
  for (const profile::PaperSize paper : sheets.papers())
    for (const char* map : {"coverage", "redundancy"})
      for (const std::string& name : sheet_names(map, paper))
        files.emplace_back(name, fmt::format("{}.tif as a map on paper", map));
  std::vector<SiteOutput> outputs;
  for (const auto& [name, what] : files) {
    outputs.push_back({place(directory, name.c_str()), what});
    policy.claim(outputs.back().path);
  }
  return outputs;
}

Document site_document(const SiteResult& r, const StoreMetadata& metadata) {
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["surface"] = surface_document(metadata, Detail::tolerance(0), r.options.themes.choice());
  document["refraction"] = earth_document(r.options.earth.earth());
  document["served"] = r.options.meaning_of_served();
  document["value"] = r.in_metric(r.choice.value);
  document["upper_bound"] = r.in_metric(r.choice.upper_bound);
  document["gap_percent"] = viewshed::gap_percent(r.choice);
  document["demand"] = r.in_metric(r.inputs.total);
  document["served_percent"] = r.served_percent();
  document["served_by_existing"] = r.in_metric(r.choice.existing);
  document["chosen"] = Document::array();
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    document["chosen"].push_back({{"id", place.name},
                                  {"x", place.position.x},
                                  {"y", place.position.y},
                                  {"height_m", place.height},
                                  {"ground_m", r.ground_m[i]},
                                  {"stands_on_m", place.ground},
                                  {"cost", r.inputs.options[site.option].cost},
                                  {"gain", r.in_metric(site.gain)},
                                  {"cumulative", r.in_metric(site.cumulative)},
                                  {"bounds_before", interval(r.summary(r.coverage.first_bounds(site.option)))},
                                  {"bounds_after", interval(r.summary(r.coverage.bounds(site.option)))}});
  }
  document["candidates"] = r.inputs.candidates.size();
  document["options"] = r.inputs.options.size();
  document["existing"] = r.inputs.existing();
  document["refined"] = r.refined();
  document["swaps"] = r.choice.swaps;
  document["left_out"] = r.inputs.rejected.size();
  document["left_out_rows"] = r.inputs.rejected;
  if (r.inputs.demand_without_ground > 0) document["demand_points_without_ground"] = r.inputs.demand_without_ground;
  document["looks"] = Document::array();
  for (int stage = 0; stage <= r.coverage.last_stage(); ++stage) {
    std::size_t stayed = 0;
    for (std::size_t i = 0; i < r.inputs.options.size(); ++i) stayed += r.coverage.stage(i) == stage;
    document["looks"].push_back({{"at", r.coverage.stage_name(stage)}, {"options_that_needed_no_more", stayed}});
  }
  document["links"] = links_document(r);
  if (r.options.hub) document["routes"] = routes_document(r);
  return document;
}

void write_site_tables(const SiteResult& result, const std::string& directory, bool overwrite) {
  write_file(place(directory, "sites.csv"), sites_csv(result), overwrite);
  write_file(place(directory, "candidates.csv"), candidates_table(result), overwrite);
  write_file(place(directory, "links.csv"), links_csv(result), overwrite);
  if (result.options.hub) write_file(place(directory, "routes.csv"), routes_csv(result), overwrite);
}

void write_site_layers(const SiteResult& result, const std::string& directory, const std::string& crs_wkt,
                       bool overwrite) {
  write_geopackage(place(directory, "sites.gpkg"), crs_wkt,
                   {sites_layer(result), candidates_layer(result), links_layer(result)}, overwrite);
}

void write_site_rasters(const SiteResult& r, const std::string& directory, const std::string& crs_wkt,
                        const std::string& parameters, bool overwrite) {
  const SiteRasters& rasters = r.rasters;
  RasterDescription description;
  description.crs_wkt = crs_wkt;
  description.overwrite = overwrite;
  description.metadata = {{"itin", ITIN_VERSION}, {"parameters", parameters}};
  std::vector<std::uint8_t> served(rasters.grid.cell_count());
  for (std::size_t i = 0; i < served.size(); ++i) {
    const std::uint16_t n = rasters.redundancy[i];
    served[i] = n == SiteRasters::kNoDemand ? 255 : static_cast<std::uint8_t>(n >= r.options.cover);
  }
  RasterDescription classes = description;
  classes.band_name = "served";
  classes.nodata = 255;
  classes.classes = {
      {0, "not served", 225, 225, 225, 255}, {1, "served", 0, 114, 178, 255}, {255, "no data", 0, 0, 0, 0}};
  write_raster(place(directory, "coverage.tif"), rasters.grid, std::span<const std::uint8_t>(served), classes);
  description.nodata = SiteRasters::kNoDemand;
  description.band_name = "sites that serve the cell";
  write_raster(place(directory, "redundancy.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.redundancy),
               description);
  description.band_name = "nearest site that serves the cell; 0 none";
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", i + 1), r.place_of(r.choice.chosen[i]).name);
  for (std::size_t i = 0; i < r.inputs.existing(); ++i)
    description.metadata.emplace_back(fmt::format("site_{}", r.choice.chosen.size() + i + 1),
                                      "existing " + r.inputs.positions[r.inputs.options.size() + i].name);
  write_raster(place(directory, "best-server.tif"), rasters.grid, std::span<const std::uint16_t>(rasters.best_server),
               description);
}

}  // namespace itin::cli
