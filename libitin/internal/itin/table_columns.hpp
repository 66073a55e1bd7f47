// The columns of a table, listed once for all formats: CSV, layers of a GIS, documents.
//
//   const std::vector<TableColumn<Mast>> columns{
//       {"name", &Mast::name},
//       {"x", [](const Mast& m) { return m.position.x; }, kInCsv, "{:.3f}"},
//       {"height_m", &Mast::height},    // std::optional<double>: may be empty
//       {"beam_deg", [](const Mast& m) { return if_any(m.antenna, &Antenna::beam_deg); }}};
//   write_file("masts.csv", csv_of(columns, masts), false);
//   layer = layer_of("masts", VectorLayer::Shape::kPoints, columns, masts, [](const Mast& m) { return places_of(m); });
//   document["masts"] = documents_of(columns, masts);
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <itin/document.hpp>
#include <itin/vector_export.hpp>

namespace itin {

/// What a row has in a column, which may be nothing.
using TableCell = std::variant<std::monostate, bool, double, std::int64_t, std::string>;

/// The formats that have a column.
enum TableFormat : std::uint8_t { kInCsv = 1, kInLayer = 2, kInDocument = 4 };
inline constexpr int kInAllFormats = kInCsv | kInLayer | kInDocument;
/// The format of flags in a CSV that are 1 and 0 there; elsewhere they are yes and no.
inline constexpr const char* kFlagsAsNumbers = "{:d}";

/// Returns the cell of a flag, a number, a text, or of what points to one of these.
template <class T>
TableCell table_cell(const T& value) {
  if constexpr (std::same_as<T, TableCell> || std::same_as<T, bool>)
    return value;
  else if constexpr (std::floating_point<T>)
    return static_cast<double>(value);
  else if constexpr (std::integral<T>)
    return static_cast<std::int64_t>(value);
  else if constexpr (std::convertible_to<T, std::string>)
    return std::string(value);
  else
    return value ? table_cell(*value) : TableCell();
}

/// Returns the type that a layer's field has for such values.
template <class T>
constexpr VectorLayer::Type field_type() {
  if constexpr (std::floating_point<T>)
    return VectorLayer::Type::kNumber;
  else if constexpr (std::integral<T>)
    return VectorLayer::Type::kWhole;
  else if constexpr (std::convertible_to<T, std::string>)
    return VectorLayer::Type::kText;
  else
    return field_type<std::remove_cvref_t<decltype(*std::declval<T>())>>();
}

/// Returns a value of what a row may not have; nothing where it has not. `of` is a function of it or a member.
template <class Part, class Of>
auto if_any(const Part& part, const Of& of) {
  return part ? std::optional(std::invoke(of, *part)) : std::nullopt;
}

template <class Row>
struct TableColumn {
  /// `of` is a function of a row or a member of it, of a value as table_cell() takes it. A CSV has numbers in this
  /// format of fmt: by default with every digit.
  template <class Of>
  TableColumn(std::string column, Of of, int in_formats = kInAllFormats, const char* number_format = "{}")
      : name(std::move(column)),
        type(field_type<std::remove_cvref_t<std::invoke_result_t<Of, const Row&>>>()),
        cell([of = std::move(of)](const Row& row) { return table_cell(std::invoke(of, row)); }),
        formats(in_formats),
        number(number_format) {}

  std::string name;
  VectorLayer::Type type;
  std::function<TableCell(const Row&)> cell;
  int formats;
  const char* number;
};

/// The cell as text; nothing is an empty one.
std::string cell_text(const TableCell& cell, const char* number = "{}");
/// The cell as text, quoted where a CSV wants that.
std::string csv_text(const TableCell& cell, const char* number = "{}");
VectorLayer::Value layer_value(const TableCell& cell);
/// Adds a member to an object where the cell is not empty.
void add_member(Document& object, const std::string& name, const TableCell& cell);

/// Returns the table with a row for each of `rows`, below the names of its columns.
template <class Row, class Rows>
std::string csv_of(const std::vector<TableColumn<Row>>& columns, const Rows& rows) {
  std::string csv;
  const auto add_line = [&](const auto& text_in) {
    for (const TableColumn<Row>& column : columns)
      if ((column.formats & kInCsv) != 0) csv += text_in(column) + ",";
    csv.back() = '\n';
  };
  add_line([](const TableColumn<Row>& column) { return csv_text(column.name); });
  for (const Row& row : rows)
    add_line([&](const TableColumn<Row>& column) { return csv_text(column.cell(row), column.number); });
  return csv;
}

/// Returns a layer with a feature for each of `rows`; `points_of` returns the points of one. `style` is that of
/// VectorLayer.
template <class Row, class Rows, class PointsOf>
VectorLayer layer_of(std::string name, VectorLayer::Shape shape, const std::vector<TableColumn<Row>>& columns,
                     const Rows& rows, const PointsOf& points_of, std::string style = {}) {
  VectorLayer layer{std::move(name), shape, {}, {}, std::move(style)};
  for (const TableColumn<Row>& column : columns)
    if ((column.formats & kInLayer) != 0) layer.fields.emplace_back(column.name, column.type);
  for (const Row& row : rows) {
    VectorLayer::Feature& feature = layer.features.emplace_back(VectorLayer::Feature{points_of(row), {}});
    for (const TableColumn<Row>& column : columns)
      if ((column.formats & kInLayer) != 0) feature.values.push_back(layer_value(column.cell(row)));
  }
  return layer;
}

/// Returns an object for the row, without what is empty.
template <class Row>
Document document_of(const std::vector<TableColumn<Row>>& columns, const Row& row) {
  Document object = Document::object();
  for (const TableColumn<Row>& column : columns)
    if ((column.formats & kInDocument) != 0) add_member(object, column.name, column.cell(row));
  return object;
}

/// Returns the objects of all rows.
template <class Row, class Rows>
Document documents_of(const std::vector<TableColumn<Row>>& columns, const Rows& rows) {
  Document array = Document::array();
  for (const Row& row : rows) array.push_back(document_of(columns, row));
  return array;
}

}  // namespace itin
