// Tables in text files, as spreadsheets, databases and people write them: the one reader of all lists and points.
//
//   TextTable table("links.csv");
//   while (table.next())
//     if (table.cells()[0].empty()) report(table.line());
//
// Cells are separated by semicolons or tabs where the first row has one outside quotes, otherwise by commas. A cell in
// double quotes may hold separators, doubled quotes, and line breaks, which become blanks. Files are in UTF-8 or
// UTF-16; rows that are neither are read as Windows-1252.
//
// These lines are no rows: blank ones, rows of separators alone, remarks (lines that begin with #), and a first line
// `sep=;`, by which Excel states the separator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iosfwd>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <itin/plain_text.hpp>

namespace itin {

class TextTable {
 public:
  /// What blanks are where the first row has no other separator: parts of a cell, or separators themselves.
  enum class Blanks { kInCells, kBetweenCells };

  /// Opens a file. Throws FileError.
  explicit TextTable(const std::string& path, Blanks blanks = Blanks::kInCells);
  /// Reads `text`, which must outlive the table; `name` is for messages.
  TextTable(std::istream& text, const std::string& name, Blanks blanks = Blanks::kInCells);
  ~TextTable();
  TextTable(const TextTable&) = delete;
  TextTable& operator=(const TextTable&) = delete;

  /// Goes to the next row; false at the end of the file. Throws FileError, and InputError for a line that is too long
  /// and for a quote that nothing closes.
  bool next();

  /// The row's cells without quotes and without blanks at their ends. They and row() hold until the next call of
  /// next().
  const std::vector<std::string_view>& cells() const { return cells_; }
  /// The cell of a column; empty where the row has none.
  std::string_view cell(std::size_t column) const { return column < cells_.size() ? cells_[column] : ""; }
  /// The row as it stands in the file.
  std::string_view row() const { return row_; }
  /// The number of the row's first line, from 1.
  std::uint64_t line() const { return line_; }
  std::uint64_t bytes_read() const;

  /// Lets rows have no more cells than this, so that others need not be found.
  void set_most_cells(std::size_t most) { most_ = most; }

  /// Tells of rows that were not UTF-8, of control characters, and of remarks that look like rows: a line each.
  std::vector<std::string> warnings() const;

 private:
  struct File;

  bool next_line();
  bool is_row();
  bool is_remark();
  void split();
  bool split_at_separators();
  void split_at_blanks();
  std::string_view kept(std::string text);
  void make_plain();

  Blanks blanks_;
  std::unique_ptr<File> file_;
  std::optional<char> separator_;
  std::size_t most_ = std::numeric_limits<std::size_t>::max();
  std::size_t width_ = 0;  ///< cells of the first row
  std::string_view row_;
  std::string joined_;  ///< the row where it is several lines of the file
  std::vector<std::string_view> cells_;
  std::deque<std::string> kept_;  ///< cells that the file has in other words: with doubled quotes, or not in UTF-8
  std::uint64_t line_ = 0;
  PlainTexts texts_;
  std::vector<std::uint64_t> remarks_;  ///< the lines of remarks that look like rows
};

}  // namespace itin
