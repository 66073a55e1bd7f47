#include "site/site_report_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/markup.hpp>
#include <viewshed/site_links.hpp>
#include <viewshed/site_wording.hpp>

#include "output/store_document.hpp"
#include "site/site_wording.hpp"

namespace itin::cli {

namespace {

/// A table of text and, from column `numbers` on, of figures. In a `wide` table, the text of a cell is not broken into
/// lines.
class HtmlTable {
 public:
  HtmlTable(const std::vector<std::string>& header, std::size_t numbers, bool wide = false)
      : numbers_(numbers), wide_(wide) {
    add(header, "th");
  }
  void add(const std::vector<std::string>& cells, const char* tag = "td") {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      html_ += fmt::format("<{0}{1}>{2}</{0}>", tag, i >= numbers_ ? " class=\"n\"" : "", escaped_markup(cells[i]));
    html_ += "</tr>\n";
  }
  std::string finish() const {
    return fmt::format("<div class=\"scroll{}\"><table>\n{}</table></div>\n", wide_ ? " wide" : "", html_);
  }

 private:
  std::size_t numbers_;
  bool wide_;
  std::string html_;
};

std::string metres_clear(const viewshed::SiteLink& link) {
  return link.found().clearance_m ? fmt::format("{:.2f}", *link.found().clearance_m) : "";
}
/// Tells whether a link of the plan crosses ground without data.
bool crosses_missing_ground(const viewshed::SitePlan& r) {
  return std::any_of(r.network.links.begin(), r.network.links.end(),
                     [](const viewshed::SiteLink& link) { return link.line.gap_m > 0; });
}
std::string fraction_clear(const viewshed::SiteLink& link) {
  return link.found().fresnel ? fmt::format("{:.2f}", link.found().fresnel->fraction) : "";
}

/// Heads a column of quantities of the demand: "Adds, cells".
std::string of_demand(const char* what, const viewshed::SitePlan& r) {
  const std::string unit = unit_of_demand(r);
  return what + (unit.empty() ? "" : "," + unit);
}

}  // namespace

/// What the table of chosen sites tells only where it differs from site to site, or from what stands beside it.
struct SiteColumns {
  bool base = false;      ///< a mast stands on a roof
  bool cost = false;      ///< some mast costs other than 1
  bool estimate = false;  ///< a first look left bounds

  explicit SiteColumns(const viewshed::SitePlan& r) : estimate(!r.all_exact()) {
    for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
      const std::size_t option = r.choice.chosen[i].option;
      base = base || std::abs(r.inputs.positions[option].ground - r.ground_m[i]) > 0.05;
      cost = cost || r.inputs.options[option].cost != 1;
    }
  }
};

std::string sites_html(const viewshed::SitePlan& r) {
  const SiteColumns shown(r);
  std::vector<std::string> head{"", "Site", "Easting", "Northing", "Mast m", "Ground m"};
  if (shown.base) head.emplace_back("Mast base m");
  if (shown.cost) head.emplace_back("Cost");
  head.insert(head.end(), {of_demand("Adds", r), "Served together", "Serves alone"});
  if (shown.estimate) head.emplace_back("First estimate");
  HtmlTable table(head, 2);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    const viewshed::OptionSurvey& survey = r.surveys[site.option];
    std::vector<std::string> row{fmt::format("{}", i + 1),
                                 place.name,
                                 fmt::format("{:.0f}", place.position.x),
                                 fmt::format("{:.0f}", place.position.y),
                                 fmt::format("{:g}", place.height),
                                 fmt::format("{:.1f}", r.ground_m[i])};
    if (shown.base) row.push_back(fmt::format("{:.1f}", place.ground));
    if (shown.cost) row.push_back(fmt::format("{:g}", r.inputs.options[site.option].cost));
    row.insert(row.end(),
               {amount(r.in_metric(site.gain)), amount(r.in_metric(site.cumulative)), amount(survey.last.certain)});
    if (shown.estimate)
      row.push_back(fmt::format("{} to {}", amount(survey.first.certain), amount(survey.first.possible)));
    table.add(row);
  }
  return table.finish();
}

std::string turbines_html(const viewshed::SitePlan& r) {
  const bool heights = r.request.sums_heights(), open = r.leaves_open;
  const char* const shows = open ? "May show m" : "Shows m";
  HtmlTable table({"", "Turbine", "Easting", "Northing", "Ground m", heights ? shows : of_demand("Adds", r), "Together",
                   open ? "May be seen from, alone" : "Seen from, alone"},
                  2);
  for (std::size_t i = 0; i < r.choice.chosen.size(); ++i) {
    const viewshed::ChosenSite& site = r.choice.chosen[i];
    const viewshed::SitePosition& place = r.place_of(site);
    table.add({fmt::format("{}", i + 1), place.name, fmt::format("{:.0f}", place.position.x),
               fmt::format("{:.0f}", place.position.y), fmt::format("{:.1f}", r.ground_m[i]),
               amount(r.in_metric(site.gain)), amount(r.in_metric(site.cumulative)),
               amount(r.surveys[site.option].last.certain)});
  }
  return table.finish();
}

/// Distances of a report are all in kilometres, with two decimals.
std::string kilometres(double metres) {
  return fmt::format("{:.2f}", metres / 1000);
}

std::string points_html(const viewshed::SitePlan& r) {
  constexpr std::size_t kMostRows = 100;
  const bool by_level = r.request.by_level();
  std::vector<std::string> head{"Point", "Service", "Nearest to serving it", "Easting", "Northing", "Weight", "km"};
  if (by_level)
    head.insert(head.end(), {"Level dBm", "Margin dB"});
  else
    head.insert(head.end(), {"Clearance m", "of F1"});
  HtmlTable table(head, 3, true);
  std::size_t unserved = 0;
  for (const viewshed::PointResult& p : r.points) {
    if (p.service == viewshed::PointService::kServed || ++unserved > kMostRows) continue;
    std::vector<std::string> row{p.point.name,
                                 name_of(p.service),
                                 p.line ? r.network.ends[p.line->site].place.name : "",
                                 fmt::format("{:.0f}", p.place.position.x),
                                 fmt::format("{:.0f}", p.place.position.y),
                                 amount(p.point.weight)};
    row.resize(9);
    if (p.line) row[6] = kilometres(p.line->distance_m);
    if (by_level) {
      if (p.line && p.line->level_dbm) row[7] = fmt::format("{:.1f}", *p.line->level_dbm);
      if (p.line && p.line->margin_db) row[8] = fmt::format("{:.1f}", *p.line->margin_db);
      table.add(row);
      continue;
    }
    if (p.line && p.line->tightest_clearance_m) row[7] = fmt::format("{:.2f}", *p.line->tightest_clearance_m);
    if (p.line && p.line->fresnel_fraction) row[8] = fmt::format("{:.2f}", *p.line->fresnel_fraction);
    table.add(row);
  }
  return fmt::format("<p class=\"note\">{} of {} not served{}.</p>\n{}", grouped(unserved),
                     counted(r.points.size(), "point"),
                     unserved > kMostRows ? fmt::format(", of which the first {} are listed", kMostRows) : "",
                     unserved > 0 ? table.finish() : "");
}

std::string stages_html(const viewshed::SitePlan& r) {
  HtmlTable table({"Survey", "Options for which it was enough"}, 1);
  for (const viewshed::SurveyStage& stage : r.stages) table.add({stage.name, grouped(stage.needed_no_more)});
  return table.finish();
}

std::string closest_html(const viewshed::SitePlan& r) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < r.inputs.options.size(); ++i) {
    const auto& margin = r.choice.closest[i];
    if (margin && !r.is_chosen(i)) order.emplace_back(-closeness(*margin, r.request.objective()), i);
  }
  if (order.empty()) return {};
  std::sort(order.begin(), order.end());
  HtmlTable table({"Candidate", r.request.turbines ? "Tip m" : "Mast m", "Survey", "Why it was not chosen"}, 4);
  for (std::size_t i = 0; i < std::min<std::size_t>(order.size(), 10); ++i) {
    const std::size_t option = order[i].second;
    table.add({r.inputs.positions[option].name, fmt::format("{:g}", r.inputs.positions[option].height),
               r.surveys[option].looked_at, r.reason(option)});
  }
  return table.finish();
}

std::string routes_html(const viewshed::SitePlan& r) {
  const viewshed::SiteNetwork& network = r.network;
  std::vector<std::string> head{"Site", "Route", "Hops km", "In all km", "Worst hop", "Clearance m"};
  if (r.request.frequency_ghz) head.emplace_back("of F1");
  if (crosses_missing_ground(r)) head.emplace_back("No data km");
  HtmlTable table(head, 5, true);
  for (const viewshed::SiteRoute& route : r.routes) {
    std::vector<std::string> row{network.ends[route.site].place.name, in_words(network, route)};
    row.resize(6);
    std::string fraction;
    double gap = 0;
    for (const viewshed::RouteHop& hop : route.hops) {
      const profile::LinkResult& line = network.links[hop.link].line;
      row[2] += (row[2].empty() ? "" : " + ") + kilometres(line.distance_m);
      gap += line.gap_m;
    }
    if (!route.hops.empty()) row[3] = kilometres(length_m(network, route));
    if (const auto worst = worst_hop(network, route)) {
      const viewshed::SiteLink& link = network.links[worst->link];
      row[4] = network.ends[worst->from].place.name + " to " + network.ends[worst->to].place.name;
      row[5] = metres_clear(link), fraction = fraction_clear(link);
    }
    if (r.request.frequency_ghz) row.push_back(fraction);
    if (crosses_missing_ground(r)) row.push_back(gap > 0 ? kilometres(gap) : "");
    table.add(row);
  }
  return table.finish();
}

std::string links_html(const viewshed::SitePlan& r) {
  std::vector<std::string> head{"From", "To", "Verdict", "km", "Clearance m"};
  if (r.request.frequency_ghz) head.emplace_back("of F1");
  if (crosses_missing_ground(r)) head.emplace_back("No data km");
  HtmlTable table(head, 3);
  for (const viewshed::SiteLink& link : r.network.links) {
    std::vector<std::string> row{r.network.from(link).name, r.network.to(link).name,
                                 viewshed::outcome_of(r.request, link), kilometres(link.line.distance_m),
                                 metres_clear(link)};
    if (r.request.frequency_ghz) row.push_back(fraction_clear(link));
    if (crosses_missing_ground(r)) row.push_back(link.line.gap_m > 0 ? kilometres(link.line.gap_m) : "");
    table.add(row);
  }
  return table.finish();
}

}  // namespace itin::cli
