#include "site/site_outputs.hpp"

#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include <itin/coordinates.hpp>

#include "output/store_document.hpp"
#include "site/site_link_outputs.hpp"

namespace itin::cli {

namespace {

Document interval(const CoverageSummary& summary) {
  return Document::array({summary.certain, summary.possible});
}

using NamesAndContents = std::vector<std::pair<std::string, std::string>>;

NamesAndContents files_of_sites() {
  return {{"sites.gpkg", "chosen sites, candidates, links between sites"},
          {"sites.csv", "chosen sites in order, with gains and bounds"},
          {"candidates.csv", "every candidate, its bounds and why it is chosen or not"},
          {"links.csv", "lines of sight between chosen sites"},
          {"coverage.tif", "what the choice and existing sites serve"},
          {"redundancy.tif", "how many of them serve a cell"},
          {"best-server.tif", "the nearest site that serves a cell"}};
}

NamesAndContents files_of_turbines() {
  return {{"turbines.csv", "the turbines, as itin ztv --turbines reads them"},
          {"turbines.gpkg", "the same for a GIS"},
          {"sites.gpkg", "turbines and candidates"},
          {"sites.csv", "turbines in order, with what each adds"},
          {"candidates.csv", "every candidate, its bounds and why it is chosen or not"},
          {"coverage.tif", "what sees the turbines, existing ones too"},
          {"redundancy.tif", "how many of them a cell sees"},
          {"best-server.tif", "the nearest of them that a cell sees"}};
}

/// Returns how much ground without data leaves open, as the value measures it and in cells of the rasters.
Document undecided_document(const SiteResult& r) {
  Document document{{"value", r.undecided}, {"part_of_value", r.options.placement.given()}};
  if (!r.options.placement.sums_heights()) document["percent"] = r.undecided_percent();
  const std::uint64_t cells = r.rasters.count(viewshed::Verdict::kUndecided);
  document["cells"] = cells;
  document["area_m2"] = static_cast<double>(cells) * r.rasters.grid.cell_area();
  document["decided_by"] = kDecidesMissingGround;
  return document;
}

}  // namespace

std::vector<SiteOutput> site_outputs(const SiteOptions& options, OutputPolicy& policy) {
  NamesAndContents files = options.placement.given() ? files_of_turbines() : files_of_sites();
  files.insert(files.end(), {{"coverage.png", "map of coverage.tif"},
                             {"redundancy.png", "map of redundancy.tif"},
                             {"report.html", "everything on one page"},
                             {"site.json", "the result as a document"},
                             {"parameters.json", "for --params: runs this again"}});
  if (options.hub) files.emplace_back("routes.csv", "the route of every site to the hub, hop by hop");
  for (const profile::PaperSize paper : options.sheets.papers())
    for (const char* map : {"coverage", "redundancy"})
      for (const std::string& name : sheet_names(map, paper))
        files.emplace_back(name, fmt::format("{}.tif as a map on paper", map));
  std::vector<SiteOutput> outputs;
  for (const auto& [name, what] : files) {
    outputs.push_back({options.path(name), what});
    policy.claim(outputs.back().path);
  }
  return outputs;
}

void remove_former_outputs(const SiteOptions& options, const Document& outputs) {
  namespace fs = std::filesystem;
  std::ifstream file(options.path("site.json"));
  const Document former = Document::parse(file, nullptr, false);
  if (!former.is_object() || !former.contains("outputs") || !former["outputs"].is_array()) return;
  // The folder may have had another name, so that files are compared by their places within the folder.
  const auto place_of = [&](const fs::path& path) {
    const bool profile = path.parent_path().filename() == kLinkFolder;
    return profile ? fs::path(kLinkFolder) / path.filename() : path.filename();
  };
  std::set<fs::path> now;
  for (const Document& output : outputs) now.insert(place_of(output["path"].get<std::string>()));
  for (const Document& output : former["outputs"]) {
    if (!output.is_object() || !output.contains("path") || !output["path"].is_string()) continue;
    const fs::path place = place_of(output["path"].get<std::string>());
    std::error_code ignored;
    if (!now.contains(place)) fs::remove(options.path(place.string()), ignored);
  }
}

Document site_document(const SiteResult& r, const StoreMetadata& metadata) {
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["surface"] = surface_document(metadata, Detail::tolerance(0), r.options.themes.choice());
  document["refraction"] = earth_document(r.options.earth.earth());
  const bool turbines = r.options.placement.given();
  document[turbines ? "objective" : "served"] = r.meaning();
  document["value"] = r.in_metric(r.choice.value);
  if (turbines) {
    document["lower_bound"] = r.in_metric(r.choice.lower_bound);
    document["proved_least"] = r.is_best();
  } else {
    document["upper_bound"] = r.in_metric(r.choice.upper_bound);
  }
  document["gap_percent"] = viewshed::gap_percent(r.choice);
  document["demand"] = r.inputs.demand.in_metric(r.inputs.total);
  if (!r.options.placement.sums_heights()) {
    document[turbines ? "seen_percent" : "served_percent"] = r.served_percent();
    document[turbines ? "seen_by_existing" : "served_by_existing"] = r.in_metric(r.choice.existing);
  }
  if (r.coverage.leaves_open()) document["undecided"] = undecided_document(r);
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

}  // namespace itin::cli
