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
  bool second_column = false;  ///< where it stands on a page that has two, if there is room
};

/// The verdict, the distances and the critical point, in sentences.
std::string verdict_line(const LosReport& report);
/// The critical point: "4532.1 m: clearance 3.20 m, 0.45 F1; terrain". A ray that is cut has its least clearance / F1
/// behind that, where it is elsewhere.
std::string critical_line(const LosReport& report);

Table facts_table(const LosReport& report);
Table ends_table(const LosReport& report);
/// Verdicts, obstructions, required heights, what the path crosses, radio, losses, edges and reflection, the tall
/// object: those there are.
std::vector<Table> result_tables(const LosReport& report);

/// The base that an end's heights count from: "ground" or "surface".
const char* base_name(bool on_surface);

/// Metres up to 2 km, kilometres beyond.
std::string distance_text(double metres);

}  // namespace itin::profile
