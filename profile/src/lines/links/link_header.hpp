// The columns of a table of links, by its header.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <profile/diffraction.hpp>

namespace itin::profile {

constexpr std::size_t kLinkColumns = 7;
constexpr std::array<const char*, kLinkColumns> kLinkNames = {"id", "x1", "y1", "h1", "x2", "y2", "h2"};

/// Columns that a header may have besides kLinkNames.
enum class LinkExtra { kName1, kName2, kFrequency, kMegahertz, kPolarisation, kCriteria };

struct LinkHeader {
  std::array<std::size_t, kLinkColumns> of{0, 1, 2, 3, 4, 5, 6};  ///< the cell that each of kLinkNames is in
  bool named = false;                                             ///< named by a header, else in the usual order
  bool numbered = false;             ///< no column is an id: links have the numbers of their rows
  bool geographic = false;           ///< positions are longitude and latitude
  bool written = false;              ///< whether x1 and y1 are one cell, as written_position() reads it
  std::size_t width = kLinkColumns;  ///< cells of a row
  std::vector<std::pair<std::size_t, LinkExtra>> extras;
  std::vector<std::pair<std::size_t, std::optional<double> BudgetQuery::*>> budget;
  std::vector<std::size_t> others;    ///< columns that have a name that is not understood
  std::vector<std::string> warnings;  ///< a line about columns that are taken by their place
};

/// Finds the columns by name where a header has any of them: x1 and y1, or what position_columns() or written_column()
/// accept in place of these. Otherwise the columns are in the usual order, and a warning says so. `names` is empty
/// where a table has no header. Throws InputError for a header with some of the names without the others.
LinkHeader link_header(const std::vector<std::string>& names, const std::string& path);

}  // namespace itin::profile
