// Judges the links of a table, and tells what was not as it may be meant.
#include <algorithm>

#include <fmt/format.h>

#include <itin/azimuth.hpp>
#include <itin/beside.hpp>
#include <itin/counted.hpp>
#include <profile/link_courses.hpp>

#include "lines/losses.hpp"

namespace itin::profile {

namespace {

void warn_of_columns(const LinkTable& table, std::vector<std::string>& warnings) {
  for (const std::string& column : table.other_columns)
    warnings.push_back(fmt::format("{}: the column '{}' is not understood; the outputs keep its cells as they are",
                                   table.path, column));
}

void warn_of_gaps(const LinkSurvey& survey, std::vector<std::string>& warnings) {
  const auto gaps =
      std::count_if(survey.results.begin(), survey.results.end(), [](const LinkResult& r) { return r.gap_m > 0; });
  if (gaps == 0 || survey.query.nodata == NoData::kClear) return;
  warnings.push_back(fmt::format("{} of {} cross ground without data, which {}; see `nodata`", gaps,
                                 counted(survey.results.size() + survey.table.bad.size(), "link"),
                                 survey.query.nodata == NoData::kBlock
                                     ? "counts as blocking"
                                     : "leaves those undecided that known ground does not hide"));
}

}  // namespace

std::optional<LinkBudget> link_budget_of(const Link& link, const LinkResult& result, const LinkQuery& query,
                                         std::optional<double> latitude_deg) {
  const BudgetCourse course{result.distance_m,
                            {result.stands_on.from_m + link.from_height, result.stands_on.to_m + link.to_height},
                            grid_azimuth_deg(link.from, link.to),
                            latitude_deg};
  return budget_over(result.losses, los_query(link, query), course);
}

LinkSurvey survey_link_table(const Store& store, LinkTable table, const LinkQuery& query, Progress& progress) {
  LinkSurvey survey{std::move(table), query, {}, {}, {}, store.path(), store.metadata(), {}};
  std::future<LinkCourses> courses =
      beside([&] { return link_courses(survey.table.links, survey.metadata.crs_wkt, progress); });
  survey.results = survey_links(store, survey.table.links, query, progress);
  survey.courses = courses.get();
  for (std::size_t i = 0; i < survey.results.size(); ++i) {
    const std::optional<LinkCourse>& course = survey.courses[i];
    const auto latitude = course ? std::optional((course->from.y + course->to.y) / 2) : std::nullopt;
    survey.budgets.push_back(link_budget_of(survey.table.links[i], survey.results[i], query, latitude));
  }
  survey.warnings = survey.table.warnings;
  warn_of_columns(survey.table, survey.warnings);
  warn_of_gaps(survey, survey.warnings);
  return survey;
}

LinkCounts counts_of(const LinkSurvey& survey) {
  LinkCounts counts;
  counts.error = survey.table.bad.size();
  for (const LinkResult& r : survey.results) {
    counts.error += !r.found;
    if (!r.found) continue;
    counts.visible += r.found->verdict == SightVerdict::kVisible;
    counts.hidden += r.found->verdict == SightVerdict::kHidden;
    counts.undecided += r.found->verdict == SightVerdict::kUndecided;
  }
  return counts;
}

}  // namespace itin::profile
