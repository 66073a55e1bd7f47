// Cells of CSV tables.
//
//   csv_cell("a, b")    // "a, b" in quotes
#pragma once

#include <optional>
#include <string>

#include <fmt/format.h>

#include <itin/plain_text.hpp>

namespace itin {

/// Returns the text as printable_text(), quoted where it has to be.
inline std::string csv_cell(const std::string& given) {
  const std::string text = printable_text(given);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Returns the number with these decimals; an empty cell for nothing.
inline std::string csv_cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "";
}

}  // namespace itin
