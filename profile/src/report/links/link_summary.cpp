// Shows many links on pages: first the links that need attention.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include <itin/crs_words.hpp>
#include <profile/budget_text.hpp>
#include <profile/radio_text.hpp>
#include <profile/report_text.hpp>

#include "report/charts/page.hpp"
#include "report/links/link_columns.hpp"

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

/// Ranks a row, by verdict and then by metres: one with a lower rank needs attention sooner.
std::pair<int, double> urgency(const LinkRow& row) {
  if (row.found() == nullptr) return {0, 0};
  const LineFindings& found = *row.found();
  const double clearance = found.clearance_m.value_or(0);
  if (found.verdict != SightVerdict::kVisible) return {found.verdict == SightVerdict::kHidden ? 1 : 2, clearance};
  const CriterionResult* c = governing(found);
  if (c == nullptr) return {5, clearance};
  constexpr int kRanks[] = {5, 3, 4};  // meets, fails, undecided
  return {kRanks[static_cast<int>(c->verdict)], c->margin_m.value_or(0)};
}

/// Returns the note on ke, for the shortest link that a criterion judges by it.
std::string fade_note_of(const std::vector<LinkRow>& rows) {
  const LinkRow* shortest = nullptr;
  for (const LinkRow& row : rows) {
    if (row.found() == nullptr || fade_note(*row.found(), row.result->distance_m).empty()) continue;
    if (shortest == nullptr || row.result->distance_m < shortest->result->distance_m) shortest = &row;
  }
  return shortest == nullptr ? "" : fade_note(*shortest->found(), shortest->result->distance_m);
}

std::string ends_text(const LinkRow& row) {
  if (row.link == nullptr) return "";
  const std::string &a = row.link->from_name, &b = row.link->to_name;
  return a.empty() && b.empty() ? "" : a + " to " + b;
}

std::string kilometres(double metres) {
  return fmt::format("{:.3f}", metres / 1000);
}

/// "7.5 GHz, horizontal" of a link; empty without a frequency.
std::string frequency_of(const LinkRow& row) {
  if (row.result == nullptr || !row.result->radio) return "";
  const RadioPath& path = *row.result->radio;
  return fmt::format("{:.6g} GHz, {}", path.frequency_ghz,
                     path.polarisation == Polarisation::kVertical ? "vertical" : "horizontal");
}

/// The frequency and polarisation that all links with one share; empty where there are several or none.
std::string shared_frequency(const std::vector<LinkRow>& rows) {
  std::set<std::string> frequencies;
  for (const LinkRow& row : rows) frequencies.insert(frequency_of(row));
  frequencies.erase("");
  return frequencies.size() == 1 ? *frequencies.begin() : "";
}

bool has_frequencies(const std::vector<LinkRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const LinkRow& row) { return !frequency_of(row).empty(); });
}

/// The cells of a budget: the margin for fades, and the availability.
std::vector<std::string> budget_cells(const LinkRow& row) {
  if (row.budget == nullptr) return {"", ""};
  const LinkBudget& budget = *row.budget;
  return {budget.margin_db ? fmt::format("{:.1f}", *budget.margin_db) : "",
          budget.availability ? availability_text(*budget.availability) : ""};
}

std::vector<std::string> cells_of(const LinkRow& row) {
  if (row.found() == nullptr) return {row.id, ends_text(row), "", "", "error: " + row.message, "", "", "", ""};
  const LineFindings& found = *row.found();
  const CriterionResult* c = governing(found);
  return {row.id,
          ends_text(row),
          kilometres(row.result->distance_m),
          row.course ? kilometres(row.course->distance_m) : "",
          name_of(found.verdict),
          found.clearance_m ? fmt::format("{:.2f}", *found.clearance_m) : "",
          found.fresnel ? fmt::format("{:.2f}", found.fresnel->fraction) : "",
          row.result->gap_m > 0 ? kilometres(row.result->gap_m) : "",
          c == nullptr ? ""
                       : fmt::format("K = {}, {:g} F1: {}", factor_text(c->criterion, c->k), c->criterion.fraction,
                                     outcome_text(*c, DistanceUnit::kKilometres))};
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

/// Whether any link has a budget.
bool has_budgets(const std::vector<LinkRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const LinkRow& row) { return row.budget != nullptr; });
}

void leave_out_empty_columns(Table& table) {
  for (std::size_t i = table.header.size(); i-- > 0;) {
    if (std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& cells) { return !cells[i].empty(); }))
      continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.header.erase(table.header.begin() + at);
    for (auto& cells : table.rows) cells.erase(cells.begin() + at);
  }
}

Table table_of(const std::vector<LinkRow>& rows) {
  std::vector<std::pair<std::pair<int, double>, const LinkRow*>> order;
  for (const LinkRow& row : rows) order.emplace_back(urgency(row), &row);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Table table{"Links, the most urgent first",
              {"id", "ends", "grid km", "geodesic km", "verdict", "clearance m", "clearance / F1", "no data km",
               "governing criterion"},
              {},
              "The order is by verdict, then by metres. Clearance is that at the critical point, clearance / F1 the "
              "least over the line."};
  const bool budgets = has_budgets(rows), frequencies = has_frequencies(rows) && shared_frequency(rows).empty();
  if (frequencies) table.header.emplace_back("frequency");
  if (budgets) table.header.insert(table.header.end(), {"margin dB", "availability"});
  for (const auto& [rank, row] : order) {
    std::vector<std::string>& cells = table.rows.emplace_back(cells_of(*row));
    if (frequencies) cells.push_back(frequency_of(*row));
    const std::vector<std::string> further = budgets ? budget_cells(*row) : std::vector<std::string>();
    cells.insert(cells.end(), further.begin(), further.end());
  }
  leave_out_empty_columns(table);
  if (budgets) table.note += fmt::format(" Budgets do not count {}.", kNeverInBudgets);
  if (const std::string note = fade_note_of(rows); !note.empty()) table.note += " " + note;
  return table;
}

/// The inputs and the settings.
std::vector<std::pair<std::string, std::string>> facts_of(const LinkSurvey& survey, const std::vector<LinkRow>& rows,
                                                          const LinkFileOptions& options) {
  const std::string& crs = survey.metadata.crs_wkt;
  std::vector<std::pair<std::string, std::string>> facts = options.facts;
  facts.insert(facts.end(), {{"Store", std::filesystem::path(survey.store).filename().string()},
                             {"CRS", crs_in_full(crs)},
                             {"Refraction", survey.query.earth.convention()}});
  if (const std::string frequency = shared_frequency(rows); !frequency.empty())
    facts.emplace_back("Frequency", frequency);
  facts.emplace_back("Program", "itin " ITIN_VERSION);
  return facts;
}

}  // namespace

std::string link_summary(const LinkSurvey& survey, const std::vector<LinkRow>& rows, const LinkFileOptions& options) {
  const Table table = table_of(rows);
  return numbered_pdf([&](Pages& pages) {
    Drawing& drawing = pages.drawing();
    draw_title(drawing, options.title);
    const double top = draw_headline(drawing, counts_text(rows)) + 14;
    const Facts facts = fact_lines(drawing, facts_of(survey, rows, options));
    const double bottom = kHeight - kMargin - kFactRow * static_cast<double>(facts.size());
    draw_facts(drawing, facts, bottom + 12);
    std::size_t row = PageColumn(drawing, kMargin, kWidth - 2 * kMargin, top).set_rows(table, 0, bottom - 30);
    while (row < table.rows.size()) {
      pages.begin_page();
      draw_title(drawing, options.title);
      row = PageColumn(drawing, kMargin, kWidth - 2 * kMargin, kBelowTitle).set_rows(table, row);
    }
    pages.add_map(options.map.get());
  });
}

}  // namespace itin::profile
