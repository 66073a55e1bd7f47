// The words and numbers of a report, as tables that every format sets in its own way.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <profile/los.hpp>

namespace itin::profile {

struct Table {
  std::string title;
  std::vector<std::string> header;  ///< empty: rows of name and value
  std::vector<std::vector<std::string>> rows;
  std::string note;  ///< below the rows; may be empty
};

/// "Hidden", with the clearance and where it is least, in one line.
std::string verdict_line(const LosReport& report);
/// The point a planner looks at: where the ray is cut deepest, or, on a free path, where the Fresnel zone is tightest,
/// if there is a frequency or if the least clearance in metres is that of a mast over its own foot.
struct TightestPoint {
  double distance_m = 0, ground_m = 0, clearance_m = 0;
  std::optional<double> fraction;  ///< of F1
  std::uint16_t theme = 0;
  std::int64_t feature = -1;
};
std::optional<TightestPoint> tightest_point(const LosReport& report);
/// "4532.1 m: clearance 3.20 m, 0.45 F1; terrain".
std::string critical_line(const LosReport& report);

Table facts_table(const LosReport& report);
Table ends_table(const LosReport& report);
/// Verdicts, obstructions, required heights, radio and losses, the tall object: those there are.
std::vector<Table> result_tables(const LosReport& report);

/// The base that an end's heights count from: "ground" or "surface".
const char* base_name(bool on_surface);

/// Metres up to 2 km, kilometres beyond.
std::string distance_text(double metres);

}  // namespace itin::profile
