#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <itin/text_table.hpp>

#include "base/line_reader.hpp"

namespace itin {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool is_blank(char c) {
  return kBlanks.find(c) != std::string_view::npos;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The separator of a row: a semicolon or a tab where it has one outside quotes, else a comma; else blanks, if they may
/// separate. Semicolons come first: where they separate, commas are decimal.
char separator_of(std::string_view row, TextTable::Blanks blanks) {
  bool quoted = false, cell_begins = true, semicolon = false, tab = false, comma = false;
  for (const char c : row) {
    const bool separates = c == ';' || c == '\t' || c == ',';
    quoted = c == '"' ? !quoted && cell_begins : quoted;
    if (c != ' ') cell_begins = separates;
    if (quoted) continue;
    semicolon = semicolon || c == ';', tab = tab || c == '\t', comma = comma || c == ',';
  }
  if (semicolon) return ';';
  if (tab) return '\t';
  return comma || blanks == TextTable::Blanks::kInCells ? ',' : ' ';
}

/// The separator that a first line `sep=;` states, in quotes or not.
std::optional<char> stated_separator(std::string_view line) {
  std::string text;
  std::copy_if(line.begin(), line.end(), std::back_inserter(text), [](char c) { return c != '"' && c != ' '; });
  std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, text.size())),
                 text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (!text.starts_with("sep=") || text.size() < 5) return std::nullopt;
  return text[4];
}

/// The position of the quote that closes a cell; `from` is behind the one that opens it.
std::size_t closing_quote(std::string_view text, std::size_t from) {
  for (std::size_t quote = text.find('"', from); quote != std::string_view::npos; quote = text.find('"', quote + 2))
    if (quote + 1 == text.size() || text[quote + 1] != '"') return quote;
  return std::string_view::npos;
}

std::string without_doubled_quotes(std::string_view text) {
  std::string single;
  for (std::size_t i = 0; i < text.size(); ++i) {
    single += text[i];
    if (text[i] == '"' && i + 1 < text.size() && text[i + 1] == '"') ++i;
  }
  return single;
}

}  // namespace

struct TextTable::File {
  explicit File(const std::string& path) : own(path, std::ios::binary), name(path), lines(opened(), name) {}
  File(std::istream& text, const std::string& title) : name(title), lines(text, name) {}

  std::istream& opened() {
    if (!own.is_open()) throw FileError(name, "cannot be opened for reading");
    return own;
  }

  std::ifstream own;
  std::string name;
  LineReader lines;
};

TextTable::TextTable(const std::string& path, Blanks blanks)
    : blanks_(blanks), file_(std::make_unique<File>(path)), texts_(path) {}

TextTable::TextTable(std::istream& text, const std::string& name, Blanks blanks)
    : blanks_(blanks), file_(std::make_unique<File>(text, name)), texts_(name) {}

TextTable::~TextTable() = default;

std::uint64_t TextTable::bytes_read() const {
  return file_->lines.bytes_read();
}

bool TextTable::next_line() {
  const auto line = file_->lines.next();
  if (line) row_ = *line;
  return line.has_value();
}

bool TextTable::next() {
  while (next_line()) {
    line_ = file_->lines.line_number();
    if (!is_row()) continue;
    if (!separator_) separator_ = separator_of(trimmed(row_), blanks_);
    split();
    make_plain();
    if (width_ == 0) width_ = cells_.size();
    return true;
  }
  return false;
}

bool TextTable::is_row() {
  if (row_.find_first_not_of(" \t,;\"") == std::string_view::npos) return false;
  if (is_remark()) return false;
  if (line_ > 1) return true;
  separator_ = stated_separator(row_);
  return !separator_;
}

/// Tells whether the line is a remark. One with as many cells as the first row may be meant as a row.
bool TextTable::is_remark() {
  if (!trimmed(row_).starts_with('#')) return false;
  if (width_ > 1 && *separator_ != ' ' && split_at_separators() && cells_.size() == width_) remarks_.push_back(line_);
  return true;
}

/// Splits the row; one whose last quote is open goes on in the next line.
void TextTable::split() {
  kept_.clear();
  if (*separator_ == ' ') return split_at_blanks();
  while (!split_at_separators()) {
    joined_.assign(std::string(row_) + ' ');
    if (!next_line() || joined_.size() + row_.size() > LineReader::kLongestLine)
      throw InputError(
          fmt::format("{}: line {}: a quote is opened and nothing closes it; double quotes that are part "
                      "of a quoted text",
                      file_->name, line_));
    row_ = joined_.append(row_);
  }
}

/// Splits at runs of blanks.
void TextTable::split_at_blanks() {
  cells_.clear();
  for (std::string_view rest = trimmed(row_); !rest.empty() && cells_.size() < most_; rest = trimmed(rest)) {
    const auto end = std::find_if(rest.begin(), rest.end(), is_blank);
    cells_.push_back(rest.substr(0, static_cast<std::size_t>(end - rest.begin())));
    rest.remove_prefix(cells_.back().size());
  }
}

/// Finds the cells; false where the last quote is open.
bool TextTable::split_at_separators() {
  cells_.clear();
  std::string_view rest = row_;
  for (std::size_t end = 0; end != std::string_view::npos && cells_.size() < most_; rest.remove_prefix(end + 1)) {
    const std::size_t start = rest.find_first_not_of(' ');
    const bool quoted = start != std::string_view::npos && rest[start] == '"';
    const std::size_t closing = quoted ? closing_quote(rest, start + 1) : 0;
    if (closing == std::string_view::npos) return false;
    end = rest.find(*separator_, closing);
    std::string_view cell = trimmed(rest.substr(0, end));
    if (quoted) {
      const std::string_view inner = rest.substr(start + 1, closing - start - 1);
      const std::string_view behind = trimmed(rest.substr(0, end).substr(closing + 1));
      const bool as_it_is = behind.empty() && inner.find('"') == std::string_view::npos;
      cell = trimmed(as_it_is ? inner : kept(without_doubled_quotes(inner) + std::string(behind)));
    }
    cells_.push_back(cell);
    if (end == std::string_view::npos) break;
  }
  return true;
}

std::string_view TextTable::kept(std::string text) {
  return kept_.emplace_back(std::move(text));
}

void TextTable::make_plain() {
  if (is_plain_text(row_)) return;
  const std::string place = fmt::format("line {}", line_);
  for (std::string_view& cell : cells_)
    if (!is_plain_text(cell)) cell = kept(texts_.plain(cell, place));
}

std::vector<std::string> TextTable::warnings() const {
  std::vector<std::string> lines = texts_.warnings();
  if (remarks_.empty()) return lines;
  const std::size_t more = remarks_.size() - 1;
  const std::string which =
      more == 0 ? "begins with # and is left out as a remark"
                : fmt::format("and {} begin with # and are left out as remarks", counted(more, "other line"));
  lines.push_back(fmt::format("{}: line {} {}; if it is a row, write its first cell in quotes", file_->name,
                              remarks_.front(), which));
  return lines;
}

}  // namespace itin
