#include "sheet/sheet_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
      : drawing_(drawing), table_(table), box_(box), type_(type), y_(box.ymin) {}

  void draw() {
    if (!table_.title.empty()) add_line(table_.title, {.size = kTitleSize * type_, .colour = kInk, .bold = true});
    draw_headings();
    const auto rows = static_cast<std::size_t>(std::max(0.0, std::floor((box_.ymax - y_) / row_height() + 0.01)));
    const bool all = table_.rows.size() <= rows;
    const std::size_t shown = all ? table_.rows.size() : std::max<std::size_t>(rows, 2) - 1;
    for (std::size_t r = 0; r < shown; ++r) draw_row(r);
    if (!all)
      add_line(fmt::format("and {} in {}", counted(table_.rows.size() - shown, "more row"), table_.elsewhere),
               {.size = 6.5 * type_, .colour = kFaint});
  }

 private:
  double row_height() const { return kRowHeight * type_; }

  /// Where a column begins; the one behind the last is the table's end.
  double column(std::size_t c) const {
    const double first = table_.first_column * box_.width();
    const double other =
        (box_.width() - first) / static_cast<double>(std::max<std::size_t>(table_.rows[0].size(), 2) - 1);
    return box_.xmin + (c == 0 ? 0 : first + other * static_cast<double>(c - 1));
  }

  void add_line(const std::string& text, const Lettering& lettering) {
    y_ += kLineHeight * lettering.size;
    drawing_.text({box_.xmin, y_ - 0.25 * lettering.size}, drawing_.fitted(text, box_.width(), lettering), lettering);
  }

  void draw_headings() {
    if (table_.headings.empty()) return;
    const Lettering lettering{.size = kCellSize * type_, .colour = kFaint};
    std::size_t from = 0;
    for (const SheetTable::Heading& heading : table_.headings) {
      const double left = column(from), right = column(from + heading.columns) - 3 * type_;
      from += heading.columns;
      if (heading.text.empty()) continue;
      drawing_.text({left, y_ + 7 * type_}, drawing_.fitted(heading.text, right - left, lettering), lettering);
      draw_rule(left, right, y_ + 9 * type_);
    }
    y_ += row_height();
  }

  void draw_row(std::size_t r) {
    const Lettering lettering{.size = kCellSize * type_, .colour = kInk, .bold = r == 0};
    for (std::size_t c = 0; c < table_.rows[r].size(); ++c)
      drawing_.text({column(c), y_ + 7 * type_},
                    drawing_.fitted(table_.rows[r][c], column(c + 1) - column(c) - 3 * type_, lettering), lettering);
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
