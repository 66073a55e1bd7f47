// What a report says in words, for every format and for the program's own text.
//
//   std::cout << verdict_text(report) << '\n';
//   for (const CriterionResult& c : report.criteria) std::cout << outcome_text(c, unit_of(report)) << '\n';
#pragma once

#include <optional>
#include <string>

#include <profile/los.hpp>

namespace itin::profile {

/// The unit of distances along a line. All that one page or text tells is in one unit.
enum class DistanceUnit { kMetres, kKilometres };
/// The unit of a report's pages: kilometres for a line of 2 km or more.
DistanceUnit unit_of(const LosReport& report);
/// Returns "1234.5 m", or "12.345 km".
std::string distance_text(double metres, DistanceUnit unit);

/// Tells of gaps: "no data over 1.200 km of the line, which leaves it undecided; known ground does not hide it". Empty
/// without gaps.
std::string gap_text(const LosReport& report, DistanceUnit unit);
/// A note about the factor ke on a line of this length; empty where no criterion asks for it.
std::string fade_note(const LineFindings& found, double length_m);
/// The text of gap_text() or, where that is empty, why the verdict is undecided; empty where neither needs words.
std::string reason_of(const LosReport& report, DistanceUnit unit);
/// Returns "Visible", or "Undecided: " with the reason. Any verdict may have a colon and a note on missing data after
/// it. Distances in it have the unit of the report's pages.
std::string verdict_text(const LosReport& report);
/// Returns "meets by 3.10 m at 5.021 km", "fails by ...", "undecided".
std::string outcome_text(const CriterionResult& result, DistanceUnit unit);
/// Returns what may follow it: "; least clearance 1.00 F1 at 5.021 km"; empty where no fraction of F1 is wanted.
std::string least_fraction_text(const CriterionResult& result, DistanceUnit unit);
/// Tells about the reflection: "clear", "screened by terrain at 5.310 km, 12.00 m above it", or that nothing is known.
/// Precondition: the report has a reflection.
std::string screen_text(const LosReport& report, DistanceUnit unit);
/// Returns metres with two decimals, never less than the height that is required; or "no height is enough".
std::string required_text(const std::optional<double>& height_m);

}  // namespace itin::profile
