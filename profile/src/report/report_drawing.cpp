// The drawing as a page: SVG and PNG have one, the PDF adds tables and the trade-off chart.
#include <algorithm>

#include <fmt/format.h>

#include "report/formats.hpp"
#include "report/sight_chart.hpp"
#include "report/tables.hpp"
#include "report/trade_off_chart.hpp"

namespace itin::profile {

namespace {

// A4 across.
constexpr double kWidth = 842, kHeight = 595, kMargin = 36;

const Lettering kPlain{8.5, kReportInk, Align::kLeft, false, 0}, kBold{8.5, kReportInk, Align::kLeft, true, 0},
    kHeadline{10, kReportInk, Align::kLeft, false, 0}, kNoteLettering{7.5, kReportGrey, Align::kLeft, false, 0};

/// Sets tables one below the other in a column.
class Column {
 public:
  Column(Drawing& drawing, double left, double width, double top)
      : drawing_(drawing), left_(left), width_(width), y_(top) {}

  double y() const { return y_; }
  bool has_room_for(const Table& table) const {
    const double rows = static_cast<double>(table.rows.size() + (table.header.empty() ? 0 : 1));
    return y_ + kTitle + rows * kRow + kNote * static_cast<double>(note_lines(table).size()) <= kHeight - kMargin;
  }

  void set(const Table& table) {
    drawing_.text({left_, y_ + 10}, table.title, {10, kReportInk, Align::kLeft, true, 0});
    y_ += kTitle;
    const Point2 rule[] = {{left_, y_}, {left_ + width_, y_}};
    drawing_.polyline(rule, {kReportGrey, 0.6, {}});
    const std::vector<double> widths = column_widths(table);
    if (!table.header.empty()) row(table.header, widths, kBold);
    for (const auto& cells : table.rows) row(cells, widths, kPlain);
    for (const std::string& line : note_lines(table)) {
      y_ += kNote;
      drawing_.text({left_, y_}, line, kNoteLettering);
    }
    y_ += 16;
  }

 private:
  std::vector<std::string> note_lines(const Table& table) const {
    if (table.note.empty()) return {};
    return drawing_.lines(table.note, width_, kNoteLettering);
  }

  /// The widths that the columns' texts need; where that is too much, the widest give way.
  std::vector<double> column_widths(const Table& table) const {
    const std::size_t columns = table.header.empty() ? table.rows.front().size() : table.header.size();
    std::vector<double> widths(columns, 0);
    const auto widen = [&](const std::vector<std::string>& cells, const Lettering& lettering) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        widths[i] = std::max(widths[i], drawing_.text_width(cells[i], lettering) + 10);
      }
    };
    widen(table.header, kBold);
    for (const auto& cells : table.rows) widen(cells, kPlain);
    double narrow = 0;
    std::size_t wide = columns;
    std::vector<double> ascending = widths;
    std::sort(ascending.begin(), ascending.end());
    for (const double w : ascending) {
      const double share = (width_ - narrow) / static_cast<double>(wide);
      if (w > share) {
        for (double& width : widths) width = std::min(width, share);
        break;
      }
      narrow += w, --wide;
    }
    return widths;
  }

  void row(const std::vector<std::string>& cells, const std::vector<double>& widths, const Lettering& lettering) {
    y_ += kRow;
    double x = left_;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      drawing_.text({x, y_}, drawing_.fitted(cells[i], widths[i] - 3, lettering), lettering);
      x += widths[i];
    }
  }

  static constexpr double kTitle = 16, kRow = 11.5, kNote = 10;

  Drawing& drawing_;
  double left_, width_, y_;
};

/// Smaller where it would not fit, and cut where it must be.
void draw_title(Drawing& drawing, const std::string& title) {
  Lettering lettering{16, kReportInk, Align::kLeft, true, 0};
  const double width = kWidth - 2 * kMargin;
  while (lettering.size > 10 && drawing.text_width(title, lettering) > width) lettering.size -= 1;
  drawing.text({kMargin, 46}, drawing.fitted(title, width, lettering), lettering);
}

void draw_first_page(Drawing& drawing, const LosReport& report) {
  draw_title(drawing, report.title);
  double top = 50;
  for (const std::string& line : drawing.lines(verdict_line(report), kWidth - 2 * kMargin, kHeadline))
    drawing.text({kMargin, top += 13}, line, kHeadline);
  top += 19;
  const double half = (kWidth - 2 * kMargin) / 2;
  const auto end = [&](double x, const char* name, const std::vector<std::string>& lines) {
    drawing.text({x, top}, name, kBold);
    double y = top;
    for (const std::string& line : lines) {
      drawing.text({x + 16, y}, drawing.fitted(line, half - 20, kPlain), kPlain);
      y += 11;
    }
  };
  end(kMargin, "A", report.from_lines);
  end(kMargin + half, "B", report.to_lines);
  const double lines = static_cast<double>(std::max(report.from_lines.size(), report.to_lines.size()));
  const double facts_height = 11 * static_cast<double>(report.facts.size());
  draw_sight_chart(drawing, {kMargin, top + 11 * lines + 2, kWidth - kMargin, kHeight - kMargin - facts_height},
                   report);
  double y = kHeight - kMargin - facts_height + 12;
  for (const auto& [name, value] : report.facts) {
    drawing.text({kMargin, y}, name, {8, kReportGrey, Align::kLeft, true, 0});
    drawing.text({kMargin + 62, y},
                 drawing.fitted(value, kWidth - 2 * kMargin - 62, {8, kReportGrey, Align::kLeft, false, 0}),
                 {8, kReportGrey, Align::kLeft, false, 0});
    y += 11;
  }
}

/// Two columns of tables per page, and as many pages as they take.
class TablePages {
 public:
  TablePages(Drawing& drawing, const LosReport& report) : drawing_(drawing), report_(report) { begin_page(); }

  void draw() {
    for (const Table& table : result_tables(report_)) {
      const bool losses = table.title == "Losses" || table.title == "Path";
      place(table, losses ? 1 : 0).set(table);
    }
    if (!has_trade_off(report_)) return;
    if (columns_[shorter()].y() + kLeastChart > kHeight - kMargin) begin_page();
    const std::size_t i = shorter();
    const double x = left_of(i), y = columns_[i].y();
    draw_trade_off_chart(drawing_, {x, y, x + kHalf, std::min(kHeight - kMargin, y + 330)}, report_);
  }

 private:
  static constexpr double kHalf = (kWidth - 3 * kMargin) / 2, kTop = 62, kLeastChart = 200;

  static double left_of(std::size_t i) { return i == 0 ? kMargin : 2 * kMargin + kHalf; }
  std::size_t shorter() const { return columns_[0].y() < columns_[1].y() ? 0 : 1; }

  void begin_page() {
    drawing_.new_page();
    draw_title(drawing_, report_.title);
    columns_.clear();
    for (const std::size_t i : {0U, 1U}) columns_.emplace_back(drawing_, left_of(i), kHalf, kTop);
  }

  Column& place(const Table& table, std::size_t preferred) {
    for (const std::size_t i : {preferred, 1 - preferred}) {
      if (columns_[i].has_room_for(table)) return columns_[i];
    }
    begin_page();
    return columns_[preferred];
  }

  Drawing& drawing_;
  const LosReport& report_;
  std::vector<Column> columns_;
};

}  // namespace

std::string report_drawing(const LosReport& report, Drawing::Format format) {
  Drawing drawing(format, kWidth, kHeight);
  draw_first_page(drawing, report);
  if (format == Drawing::Format::kPdf) TablePages(drawing, report).draw();
  return drawing.finish();
}

}  // namespace itin::profile
