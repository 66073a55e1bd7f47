// Reads the shares of months in which the sun shines and turbines turn.

#include <optional>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parsed_number.hpp>
#include <itin/position_columns.hpp>
#include <itin/text_table.hpp>
#include <viewshed/dwellings.hpp>

namespace itin::viewshed {

namespace {

/// The columns of the table; nothing for one that it does not have.
struct MonthColumns {
  std::optional<std::size_t> month, sunshine, operation;
};

MonthColumns month_columns(const std::string& path, const TextTable& table) {
  const std::vector<std::string> names(table.cells().begin(), table.cells().end());
  const MonthColumns columns{column_named(names, "month"), column_named(names, "sunshine"),
                             column_named(names, "operation")};
  if (!columns.month || (!columns.sunshine && !columns.operation))
    throw InputError(
        fmt::format("{}: its first line must name the columns month, and sunshine or operation or both", path),
        "months");
  return columns;
}

}  // namespace

std::array<MonthShare, 12> read_months(const std::string& path) {
  TextTable table(path);
  if (!table.next()) throw InputError(fmt::format("{}: it is empty", path), "months");
  const MonthColumns columns = month_columns(path, table);
  std::array<std::optional<MonthShare>, 12> found;
  const auto place = [&] { return fmt::format("{}, line {}", path, table.line()); };
  const auto share = [&](const std::optional<std::size_t>& column, const char* name) {
    if (!column) return 1.0;
    const std::string cell(table.cell(*column));
    const double value = parse_number(fmt::format("{}: {}", place(), name), cell, NumberRange::kNotNegative);
    if (value > 1) throw InputError(fmt::format("{}: {} '{}': give a part of 1", place(), name, cell), "months");
    return value;
  };
  while (table.next()) {
    const double month = parse_number(place() + ": month", std::string(table.cell(*columns.month)), NumberRange::kAny);
    if (!(month >= 1 && month <= 12 && month == static_cast<int>(month)))
      throw InputError(fmt::format("{}: month '{}': give 1 to 12", place(), table.cell(*columns.month)), "months");
    auto& entry = found[static_cast<std::size_t>(month) - 1];
    if (entry) throw InputError(fmt::format("{}: month {} comes twice", place(), month), "months");
    entry = MonthShare{share(columns.sunshine, "sunshine"), share(columns.operation, "operation")};
  }
  std::array<MonthShare, 12> shares;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i]) throw InputError(fmt::format("{}: month {} is missing", path, i + 1), "months");
    shares[i] = *found[i];
  }
  return shares;
}

}  // namespace itin::viewshed
