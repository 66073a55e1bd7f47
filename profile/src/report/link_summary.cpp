// Shows many links on one page: first the links that need attention.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>

#include "report/link_columns.hpp"
#include "report/page.hpp"

namespace itin::profile {

namespace {

/// The criterion that fails, else one that is undecided, else one that is met; among these the one with the least
/// margin. Null if there is none.
const CriterionResult* governing(const LineFindings& found) {
  const auto rank = [](const CriterionResult& c) {
    constexpr int kRanks[] = {2, 0, 1};  // meets, fails, undecided
    return std::pair(kRanks[static_cast<int>(c.verdict)], c.margin_m.value_or(0));
  };
  const auto worst =
      std::min_element(found.criteria.begin(), found.criteria.end(),
                       [&](const CriterionResult& a, const CriterionResult& b) { return rank(a) < rank(b); });
  return worst == found.criteria.end() ? nullptr : &*worst;
}

/// Ranks a row: one with a lower number needs attention sooner.
int urgency(const LinkRow& row) {
  if (row.found() == nullptr) return 0;
  if (row.found()->verdict != SightVerdict::kVisible) return row.found()->verdict == SightVerdict::kHidden ? 1 : 2;
  const CriterionResult* c = governing(*row.found());
  if (c == nullptr || c->verdict == CriterionVerdict::kMeets) return 5;
  return c->verdict == CriterionVerdict::kFails ? 3 : 4;
}

std::string ends_text(const LinkRow& row) {
  if (row.link == nullptr) return "";
  const std::string &a = row.link->from_name, &b = row.link->to_name;
  return a.empty() && b.empty() ? "" : a + " to " + b;
}

std::string kilometres(double metres) {
  return fmt::format("{:.3f}", metres / 1000);
}

std::vector<std::string> cells_of(const LinkRow& row) {
  if (row.found() == nullptr) return {row.id, ends_text(row), "", "", "error: " + row.message, "", "", "", ""};
  const LineFindings& found = *row.found();
  const CriterionResult* c = governing(found);
  return {row.id,
          ends_text(row),
          kilometres(row.result->distance_m),
          row.geodesic ? kilometres(row.geodesic->distance_m) : "",
          name_of(found.verdict),
          found.clearance_m ? fmt::format("{:.2f}", *found.clearance_m) : "",
          found.fresnel ? fmt::format("{:.2f}", found.fresnel->fraction) : "",
          row.result->gap_m > 0 ? kilometres(row.result->gap_m) : "",
          c == nullptr ? ""
                       : fmt::format("K = {}, {:g} F1: {}", factor_text(c->criterion, c->k), c->criterion.fraction,
                                     outcome_text(*c))};
}

std::string counts_text(const std::vector<LinkRow>& rows) {
  std::map<std::string, std::size_t> verdicts;
  std::size_t judged = 0, met = 0;
  for (const LinkRow& row : rows) {
    ++verdicts[verdict_of(row)];
    if (row.found() == nullptr || row.found()->criteria.empty()) continue;
    ++judged;
    met += governing(*row.found())->verdict == CriterionVerdict::kMeets;
  }
  std::string text = fmt::format("{} link{}:", rows.size(), rows.size() == 1 ? "" : "s");
  for (const char* verdict : {"visible", "hidden", "undecided"})
    if (verdicts[verdict] > 0) text += fmt::format(" {} {},", verdicts[verdict], verdict);
  if (verdicts["error"] > 0) text += fmt::format(" {} could not be computed,", verdicts["error"]);
  text.back() = '.';
  if (judged > 0) text += fmt::format(" {} of {} meet every criterion.", met, judged);
  return text;
}

}  // namespace

std::string link_summary(const LinkSurvey& survey, const std::vector<LinkRow>& rows) {
  Drawing drawing(Drawing::Format::kPdf, kWidth, kHeight);
  draw_title(drawing, survey.title);
  const double top = draw_headline(drawing, counts_text(rows)) + 14;
  const Facts facts = fact_lines(drawing, survey.facts);
  const double bottom = kHeight - kMargin - kFactRow * static_cast<double>(facts.size());
  std::vector<const LinkRow*> order;
  for (const LinkRow& row : rows) order.push_back(&row);
  std::stable_sort(order.begin(), order.end(),
                   [](const LinkRow* a, const LinkRow* b) { return urgency(*a) < urgency(*b); });
  PageColumn column(drawing, kMargin, kWidth - 2 * kMargin, top);
  Table table{"Links, the most urgent first",
              {"id", "ends", "grid km", "geodesic km", "verdict", "clearance m", "clearance / F1", "no data km",
               "governing criterion"},
              {},
              "Clearance is that at the critical point, clearance / F1 the least over the line."};
  const std::size_t fitting = std::min(rows.size(), column.rows_that_fit(table, bottom - 30));
  for (std::size_t i = 0; i < fitting; ++i) table.rows.push_back(cells_of(*order[i]));
  if (fitting < rows.size()) table.note += fmt::format(" The table has {} more.", rows.size() - fitting);
  column.set(table);
  draw_facts(drawing, facts, bottom + 12);
  return drawing.finish();
}

}  // namespace itin::profile
