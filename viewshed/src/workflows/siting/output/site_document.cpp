#include <itin/coordinates.hpp>
#include <viewshed/premises_document.hpp>
#include <viewshed/site_document.hpp>

#include "workflows/siting/output/link_tables.hpp"
#include "workflows/siting/output/point_tables.hpp"
#include "workflows/siting/output/site_tables.hpp"
#include "workflows/siting/request_rules.hpp"

namespace itin::viewshed {

namespace {

/// Returns how much ground without data leaves open, as the value measures it and in cells of the rasters.
Document undecided_of(const SitePlan& r) {
  Document document{{"value", r.undecided}, {"part_of_value", r.request.turbines.has_value()}};
  if (!r.request.sums_heights()) document["percent"] = r.undecided_percent();
  const std::uint64_t cells = r.rasters.count(Verdict::kUndecided);
  document["cells"] = cells;
  document["area_m2"] = static_cast<double>(cells) * r.rasters.grid.cell_area();
  return document;
}

}  // namespace

Document site_document(const SitePlan& r, const StoreMetadata& metadata) {
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["surface"] = surface_document(metadata, Detail::tolerance(0), r.request.themes);
  document["refraction"] = earth_document(r.request.earth);
  const bool turbines = r.request.turbines.has_value();
  document[turbines ? "objective" : "served"] = r.meaning();
  document["value"] = r.in_metric(r.choice.value);
  if (turbines) {
    document["lower_bound"] = r.in_metric(r.choice.lower_bound);
    document["proved_least"] = r.is_best();
  } else {
    document["upper_bound"] = r.in_metric(r.choice.upper_bound);
  }
  document["gap_percent"] = gap_percent(r.choice);
  if (r.request.share || r.request.budget) document["cost"] = r.choice.cost;
  if (r.choice.least_cost) document["least_cost"] = *r.choice.least_cost;
  document["demand"] = r.inputs.demand.in_metric(r.inputs.total);
  if (!r.request.sums_heights()) {
    document[turbines ? "seen_percent" : "served_percent"] = r.served_percent();
    document[turbines ? "seen_by_existing" : "served_by_existing"] = r.in_metric(r.choice.existing);
  }
  if (r.leaves_open) document["undecided"] = undecided_of(r);
  if (r.premises) document["premises"] = counts_document(r.premises->counts());
  if (tells_points(r.request)) document["demand_points"] = points_document(r);
  document["chosen"] = chosen_document(r);
  document["candidates"] = r.inputs.candidates.size();
  document["options"] = r.inputs.options.size();
  document["existing"] = r.inputs.existing();
  document["refined"] = r.refined();
  document["swaps"] = r.choice.swaps;
  document["left_out"] = r.inputs.left_out.size();
  document["left_out_rows"] = r.inputs.left_out;
  if (r.inputs.demand_without_ground > 0) document["demand_points_without_ground"] = r.inputs.demand_without_ground;
  document["looks"] = Document::array();
  for (const SurveyStage& stage : r.stages)
    document["looks"].push_back({{"at", stage.name}, {"options_that_needed_no_more", stage.needed_no_more}});
  document["links"] = links_document(r);
  if (r.request.hub) document["routes"] = routes_document(r);
  return document;
}

std::string json_of(const SitePlan& plan, const StoreMetadata& metadata) {
  return json_text(site_document(plan, metadata), 2);
}

}  // namespace itin::viewshed
