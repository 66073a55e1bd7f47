// Lists what is said about each of many links: one list of columns for every format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/table_columns.hpp>
#include <profile/links.hpp>

namespace itin::profile {

/// A row of the table, in its order.
struct LinkRow {
  std::string id;
  const Link* link = nullptr;          ///< null: the row could not be read
  const LinkResult* result = nullptr;  ///< null: the row could not be read
  std::string message;                 ///< what went wrong, where there was an error
  const std::vector<std::string>* others = nullptr;
  const LinkBudget* budget = nullptr;     ///< null where there is none
  std::optional<LinkCourse> course = {};  ///< nothing where the link could not be computed
  /// The declination of magnetic north at the ends, on the survey's day.
  std::optional<double> from_declination_deg = {}, to_declination_deg = {};

  /// The findings; null where the link could not be computed.
  const LineFindings* found() const { return result != nullptr && result->found ? &*result->found : nullptr; }
};
std::vector<LinkRow> link_rows(const LinkSurvey& survey);

using LinkColumn = TableColumn<LinkRow>;
std::vector<LinkColumn> link_columns(const LinkSurvey& survey, const std::vector<LinkRow>& rows);

/// Returns "visible", "hidden", "undecided" or "error".
std::string verdict_of(const LinkRow& row);

/// Draws the summary, one page.
std::string link_summary(const LinkSurvey& survey, const std::vector<LinkRow>& rows, const LinkFileOptions& options);

}  // namespace itin::profile
