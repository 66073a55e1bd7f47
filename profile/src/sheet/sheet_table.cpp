#include "sheet/sheet_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include <fmt/format.h>

#include <itin/counted.hpp>

#include "drawing/palette.hpp"

namespace itin::profile {

namespace {

/// Sizes of letters, and the height of a row, points.
constexpr double kTitleSize = 9, kCellSize = 7, kRowHeight = 9.6, kLineHeight = 1.25;

class TablePage {
 public:
  TablePage(Drawing& drawing, const SheetTable& table, const Box& box, double type)
      : drawing_(drawing), table_(table), box_(box), type_(type), y_(box.ymin) {
    const std::vector<double> wanted = wanted_widths();
    std::vector<double> widths = equal_widths();
    const bool cut = std::ranges::mismatch(wanted, widths, std::ranges::less_equal()).in1 != wanted.end();
    if (cut) widths = shared_out(wanted, box.width());
    columns_.push_back(box.xmin);
    for (const double width : widths) columns_.push_back(columns_.back() + width);
  }

  void draw() {
    if (!table_.title.empty()) add_line(table_.title, {.size = kTitleSize * type_, .colour = kInk, .bold = true});
    draw_headings();
    const auto rows = static_cast<std::size_t>(std::max(0.0, std::floor((box_.ymax - y_) / row_height() + 0.01)));
    const bool all = table_.rows.size() <= rows;
    const std::size_t shown = all ? table_.rows.size() : std::max<std::size_t>(rows, 2) - 1;
    for (std::size_t r = 0; r < shown; ++r) draw_row(r);
    if (!all)
      add_line(fmt::format("and {}{}{}", counted(table_.rows.size() - shown, "more row"),
                           table_.rest.empty() ? "" : ", ", table_.rest),
               {.size = 6.5 * type_, .colour = kFaint});
  }

 private:
  double row_height() const { return kRowHeight * type_; }

  /// Where a column begins; the one behind the last is the table's end.
  double column(std::size_t c) const { return columns_[c]; }
  double gap() const { return 3 * type_; }
  Lettering cell_lettering(std::size_t row) const {
    return {.size = kCellSize * type_, .colour = kInk, .bold = row == 0};
  }
  Lettering heading_lettering() const { return {.size = kCellSize * type_, .colour = kFaint}; }

  /// The first column has its part of the width, and the others have equal ones.
  std::vector<double> equal_widths() const {
    const std::size_t count = table_.rows[0].size();
    const double first = table_.first_column * box_.width();
    std::vector<double> widths(count,
                               (box_.width() - first) / static_cast<double>(std::max<std::size_t>(count, 2) - 1));
    widths.front() = first;
    return widths;
  }

  /// The widths at which no cell and no heading is cut.
  std::vector<double> wanted_widths() const {
    std::vector<double> widths(table_.rows[0].size());
    for (std::size_t r = 0; r < table_.rows.size(); ++r)
      for (std::size_t c = 0; c < std::min(widths.size(), table_.rows[r].size()); ++c)
        widths[c] = std::max(widths[c], drawing_.text_width(table_.rows[r][c], cell_lettering(r)) + gap());
    std::size_t from = 0;
    for (const SheetTable::Heading& heading : table_.headings) {
      const std::span<double> under = std::span(widths).subspan(from, heading.columns);
      const double wide = drawing_.text_width(heading.text, heading_lettering()) + gap();
      const double lack = wide - std::accumulate(under.begin(), under.end(), 0.0);
      for (double& width : under) width += std::max(lack, 0.0) / static_cast<double>(heading.columns);
      from += heading.columns;
    }
    return widths;
  }

  /// Shares out a width among columns: what is left over goes to all alike, and what is lacking is taken from the
  /// widest.
  static std::vector<double> shared_out(std::vector<double> wanted, double width) {
    const double left = width - std::accumulate(wanted.begin(), wanted.end(), 0.0);
    if (left >= 0) {
      for (double& column : wanted) column += left / static_cast<double>(wanted.size());
      return wanted;
    }
    std::vector<double> ascending = wanted;
    std::ranges::sort(ascending);
    double most = 0, rest = width;
    for (std::size_t i = 0; i < ascending.size(); ++i) {
      most = rest / static_cast<double>(ascending.size() - i);
      if (ascending[i] > most) break;
      rest -= ascending[i];
    }
    for (double& column : wanted) column = std::min(column, most);
    return wanted;
  }

  void add_line(const std::string& text, const Lettering& lettering) {
    y_ += kLineHeight * lettering.size;
    drawing_.text({box_.xmin, y_ - 0.25 * lettering.size}, drawing_.fitted(text, box_.width(), lettering), lettering);
  }

  void draw_headings() {
    if (table_.headings.empty()) return;
    const Lettering lettering = heading_lettering();
    std::size_t from = 0;
    for (const SheetTable::Heading& heading : table_.headings) {
      const double left = column(from), right = column(from + heading.columns) - gap();
      from += heading.columns;
      if (heading.text.empty()) continue;
      drawing_.text({left, y_ + 7 * type_}, drawing_.fitted(heading.text, right - left, lettering), lettering);
      draw_rule(left, right, y_ + 9 * type_);
    }
    y_ += row_height();
  }

  void draw_row(std::size_t r) {
    const Lettering lettering = cell_lettering(r);
    for (std::size_t c = 0; c < table_.rows[r].size(); ++c)
      drawing_.text({column(c), y_ + 7 * type_},
                    drawing_.fitted(table_.rows[r][c], column(c + 1) - column(c) - gap(), lettering), lettering);
    y_ += row_height();
    if (r == 0) draw_rule(box_.xmin, box_.xmax, y_ - 0.6 * type_);
  }

  void draw_rule(double from, double to, double y) {
    drawing_.polyline(std::array{Point2{from, y}, Point2{to, y}}, {kFaint, 0.4 * type_, {}});
  }

  Drawing& drawing_;
  const SheetTable& table_;
  Box box_;
  double type_, y_;
  std::vector<double> columns_;  ///< where they begin, and where the last ends
};

}  // namespace

void draw_sheet_table(Drawing& drawing, const SheetTable& table, const Box& box, double type) {
  TablePage(drawing, table, box, type).draw();
}

double height_of_table(const SheetTable& table, double type) {
  const std::size_t rows = table.rows.size() + (table.headings.empty() ? 0 : 1);
  const double title = table.title.empty() ? 0 : kLineHeight * kTitleSize;
  return (title + kRowHeight * static_cast<double>(rows)) * type;
}

}  // namespace itin::profile
