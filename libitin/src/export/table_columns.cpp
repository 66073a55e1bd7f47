#include <string_view>

#include <fmt/format.h>

#include <itin/plain_text.hpp>
#include <itin/table_columns.hpp>

namespace itin {

std::string cell_text(const TableCell& cell, const char* number) {
  if (const auto* flag = std::get_if<bool>(&cell)) {
    if (std::string_view(number) == kFlagsAsNumbers) return *flag ? "1" : "0";
    return *flag ? "yes" : "no";
  }
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format(fmt::runtime(number), *value);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return "";
}

std::string csv_text(const TableCell& cell, const char* number) {
  if (!std::holds_alternative<std::string>(cell)) return cell_text(cell, number);
  const std::string text = printable_text(std::get<std::string>(cell));
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

VectorLayer::Value layer_value(const TableCell& cell) {
  if (const auto* flag = std::get_if<bool>(&cell)) return std::int64_t{*flag};
  if (const auto* value = std::get_if<double>(&cell)) return *value;
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return {};
}

void add_member(Document& object, const std::string& name, const TableCell& cell) {
  std::visit(
      [&](const auto& value) {
        if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(value)>, std::monostate>) object[name] = value;
      },
      cell);
}

}  // namespace itin
