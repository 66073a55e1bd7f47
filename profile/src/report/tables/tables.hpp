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
  std::string note;            ///< below the rows; may be empty
  bool second_column = false;  ///< whether it stands in the second column of a page, if there is room
};

/// The verdict, the distances and the critical point, in sentences.
std::string verdict_line(const LosReport& report);
/// Describes the critical point: "4532.1 m: clearance 3.20 m, 0.45 F1; terrain". For a ray that is cut, the least
/// clearance / F1 follows if it is elsewhere.
std::string critical_line(const LosReport& report);

Table facts_table(const LosReport& report);
Table ends_table(const LosReport& report);
/// Makes tables of verdicts, obstructions, required heights, what the path crosses, radio, losses, edges and
/// reflection, and the tall object, so far as the report has them.
std::vector<Table> result_tables(const LosReport& report);

/// The base that an end's heights count from: "ground" or "surface".
const char* base_name(bool on_surface);

}  // namespace itin::profile
