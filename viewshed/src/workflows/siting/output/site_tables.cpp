#include "workflows/siting/output/site_tables.hpp"

#include <vector>

#include <itin/document.hpp>
#include <itin/feature_style.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/result_sheet.hpp>

namespace itin::viewshed {

namespace {

/// A place that was chosen, with its rank, or that could have been.
struct PlaceRow {
  std::size_t number;
  const SitePosition& place;
  const SiteOption& option;
  const OptionSurvey& survey;
};

using PlaceColumns = std::vector<TableColumn<PlaceRow>>;

std::vector<PlaceRow> chosen_rows(const SitePlan& r) {
  std::vector<PlaceRow> rows;
  for (const ChosenSite& site : r.choice.chosen)
    rows.push_back({rows.size(), r.place_of(site), r.inputs.options[site.option], r.surveys[site.option]});
  return rows;
}

std::vector<PlaceRow> option_rows(const SitePlan& r) {
  std::vector<PlaceRow> rows;
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i)
    rows.push_back({i, r.inputs.positions[i], r.inputs.options[i], r.surveys[i]});
  return rows;
}

double place_x(const PlaceRow& row) {
  return row.place.position.x;
}
double place_y(const PlaceRow& row) {
  return row.place.position.y;
}
std::string name_of_place(const PlaceRow& row) {
  return row.place.name;
}
double place_height(const PlaceRow& row) {
  return row.place.height;
}
double option_cost(const PlaceRow& row) {
  return row.option.cost;
}

PlaceColumns chosen_columns(const SitePlan& r) {
  const auto rank = [](const PlaceRow& row) { return row.number + 1; };
  const auto ground = [&r](const PlaceRow& row) { return r.ground_m[row.number]; };
  const auto stands_on = [](const PlaceRow& row) { return row.place.ground; };
  const auto metric = [&r](Weight ChosenSite::*weight) {
    return [&r, weight](const PlaceRow& row) { return r.in_metric(r.choice.chosen[row.number].*weight); };
  };
  return {{"order", rank, kInCsv},
          {"rank", rank, kInLayer},
          {"id", name_of_place},
          {"x", place_x, kInCsv | kInDocument},
          {"y", place_y, kInCsv | kInDocument},
          {"height_m", place_height},
          {"ground_m", ground, kInCsv | kInDocument, "{:.3f}"},
          {"stands_on_m", stands_on, kInDocument},
          {"cost", option_cost},
          {"gain", metric(&ChosenSite::gain)},
          {"cumulative", metric(&ChosenSite::cumulative)},
          {"coverage", [](const PlaceRow& row) { return row.survey.last.certain; }, kInCsv},
          {"first_certain", [](const PlaceRow& row) { return row.survey.first.certain; }, kInCsv},
          {"first_possible", [](const PlaceRow& row) { return row.survey.first.possible; }, kInCsv},
          {"stands_on_m", stands_on, kInCsv, "{:.3f}"}};
}

PlaceColumns candidate_columns(const SitePlan& r) {
  return {{"id", name_of_place},
          {"x", place_x, kInCsv},
          {"y", place_y, kInCsv},
          {"height_m", place_height},
          {"cost", option_cost},
          {"looked_at", [](const PlaceRow& row) { return row.survey.looked_at; }},
          {"first_certain", [](const PlaceRow& row) { return row.survey.first.certain; }, kInCsv},
          {"first_possible", [](const PlaceRow& row) { return row.survey.first.possible; }, kInCsv},
          {"certain", [](const PlaceRow& row) { return row.survey.last.certain; }},
          {"possible", [](const PlaceRow& row) { return row.survey.last.possible; }},
          {"proposed_as", [&r](const PlaceRow& row) { return r.candidate(row.number).proposed_as; }, kInCsv},
          {"outcome", [&r](const PlaceRow& row) { return r.reason(row.number); }}};
}

/// The columns that `itin ztv` reads.
PlaceColumns turbine_columns(const TurbinePlacement& placement) {
  return {{"name", name_of_place},
          {"x", place_x, kInCsv},
          {"y", place_y, kInCsv},
          {"hub_height", [&placement](const PlaceRow&) { return placement.hub_height; }},
          {"rotor_diameter", [&placement](const PlaceRow&) { return placement.rotor_diameter; }},
          {"tip_height", [&placement](const PlaceRow&) { return placement.tip_height; }},
          {"farm", [&placement](const PlaceRow&) { return placement.farm; }}};
}

/// A layer of points on the ground.
VectorLayer layer_of_places(const char* name, const PlaceColumns& columns, const std::vector<PlaceRow>& rows,
                            const FeatureClass& all) {
  const auto point = [](const PlaceRow& row) {
    return std::vector<Point3>{{place_x(row), place_y(row), row.place.ground}};
  };
  return layer_of(name, VectorLayer::Shape::kPoints, columns, rows, point, point_style(all));
}

}  // namespace

std::string sites_csv(const SitePlan& r) {
  return csv_of(chosen_columns(r), chosen_rows(r));
}

std::string candidates_csv(const SitePlan& r) {
  return csv_of(candidate_columns(r), option_rows(r));
}

std::string turbines_csv(const SitePlan& r) {
  return csv_of(turbine_columns(*r.request.turbines), chosen_rows(r));
}

Document chosen_document(const SitePlan& r) {
  const auto interval = [](const CoverageSummary& s) { return Document::array({s.certain, s.possible}); };
  const PlaceColumns columns = chosen_columns(r);
  Document chosen = Document::array();
  for (const PlaceRow& row : chosen_rows(r)) {
    Document& entry = chosen.emplace_back(document_of(columns, row));
    entry["bounds_before"] = interval(row.survey.first);
    entry["bounds_after"] = interval(row.survey.last);
  }
  return chosen;
}

VectorLayer sites_layer(const SitePlan& r) {
  return layer_of_places("sites", chosen_columns(r), chosen_rows(r), {"site", "Chosen site", kMastColour});
}

VectorLayer candidates_layer(const SitePlan& r) {
  return layer_of_places("candidates", candidate_columns(r), option_rows(r),
                         {"candidate", "Candidate", {170, 170, 170}});
}

VectorLayer turbines_layer(const SitePlan& r) {
  return layer_of_places("turbines", turbine_columns(*r.request.turbines), chosen_rows(r),
                         {"turbine", "Chosen turbine", kMastColour});
}

}  // namespace itin::viewshed
