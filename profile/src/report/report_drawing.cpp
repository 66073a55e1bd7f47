// The drawing as a page: SVG and PNG have one, the PDF adds a second of tables and the trade-off chart.
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

const Lettering kPlain{8.5, kInk, Align::kLeft, false, 0}, kBold{8.5, kInk, Align::kLeft, true, 0};

/// The text cut to a width, with an ellipsis.
std::string fitted(const Drawing& drawing, std::string text, double width, const Lettering& lettering) {
  if (drawing.text_width(text, lettering) <= width) return text;
  const std::string dots = "\xE2\x80\xA6";
  while (!text.empty() && drawing.text_width(text + dots, lettering) > width) {
    do text.pop_back();
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80);
  }
  return text + dots;
}

/// Sets tables one below the other in a column.
class Column {
 public:
  Column(Drawing& drawing, double left, double width, double top)
      : drawing_(drawing), left_(left), width_(width), y_(top) {}

  double y() const { return y_; }

  void set(const Table& table) {
    drawing_.text({left_, y_ + 10}, table.title, {10, kInk, Align::kLeft, true, 0});
    y_ += 16;
    const Point2 rule[] = {{left_, y_}, {left_ + width_, y_}};
    drawing_.polyline(rule, {kGrey, 0.6, {}});
    const std::vector<double> widths = column_widths(table);
    if (!table.header.empty()) row(table.header, widths, kBold);
    for (const auto& cells : table.rows) row(cells, widths, kPlain);
    if (!table.note.empty()) {
      y_ += 10;
      drawing_.text({left_, y_}, fitted(drawing_, table.note, width_, {7.5, kGrey, Align::kLeft, false, 0}),
                    {7.5, kGrey, Align::kLeft, false, 0});
    }
    y_ += 16;
  }

 private:
  /// What each column would like, shared out in proportion.
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
    double sum = 0;
    for (const double w : widths) sum += w;
    const double scale = width_ / sum;
    // What is wider than the column shrinks in proportion; what is narrower keeps its width.
    if (scale < 1) {
      for (double& w : widths) w *= scale;
    }
    return widths;
  }

  void row(const std::vector<std::string>& cells, const std::vector<double>& widths, const Lettering& lettering) {
    y_ += 11.5;
    double x = left_;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      drawing_.text({x, y_}, fitted(drawing_, cells[i], widths[i] - 3, lettering), lettering);
      x += widths[i];
    }
  }

  Drawing& drawing_;
  double left_, width_, y_;
};

void draw_first_page(Drawing& drawing, const LosReport& report) {
  drawing.text({kMargin, 46}, report.title, {16, kInk, Align::kLeft, true, 0});
  drawing.text({kMargin, 63},
               fitted(drawing, verdict_line(report), kWidth - 2 * kMargin, {10, kInk, Align::kLeft, false, 0}),
               {10, kInk, Align::kLeft, false, 0});
  const double half = (kWidth - 2 * kMargin) / 2;
  const auto end = [&](double x, const char* name, const std::vector<std::string>& lines) {
    drawing.text({x, 82}, name, kBold);
    double y = 82;
    for (const std::string& line : lines) {
      drawing.text({x + 16, y}, fitted(drawing, line, half - 20, kPlain), kPlain);
      y += 11;
    }
  };
  end(kMargin, "A", report.from_lines);
  end(kMargin + half, "B", report.to_lines);
  const double lines = static_cast<double>(std::max(report.from_lines.size(), report.to_lines.size()));
  const double facts_height = 11 * static_cast<double>(report.facts.size());
  draw_sight_chart(drawing, {kMargin, 82 + 11 * lines + 2, kWidth - kMargin, kHeight - kMargin - facts_height}, report);
  double y = kHeight - kMargin - facts_height + 12;
  for (const auto& [name, value] : report.facts) {
    drawing.text({kMargin, y}, name, {8, kGrey, Align::kLeft, true, 0});
    drawing.text({kMargin + 62, y},
                 fitted(drawing, value, kWidth - 2 * kMargin - 62, {8, kGrey, Align::kLeft, false, 0}),
                 {8, kGrey, Align::kLeft, false, 0});
    y += 11;
  }
}

void draw_second_page(Drawing& drawing, const LosReport& report) {
  drawing.text({kMargin, 46}, report.title, {16, kInk, Align::kLeft, true, 0});
  const double half = (kWidth - 3 * kMargin) / 2;
  Column left(drawing, kMargin, half, 62), right(drawing, 2 * kMargin + half, half, 62);
  for (const Table& table : result_tables(report)) {
    const bool losses = table.title == "Losses" || table.title == "Path";
    (losses ? right : left).set(table);
  }
  if (!has_trade_off(report)) return;
  Column& shorter = left.y() < right.y() ? left : right;
  const double x = &shorter == &left ? kMargin : 2 * kMargin + half;
  const double bottom = std::min(kHeight - kMargin, shorter.y() + 330);
  draw_trade_off_chart(drawing, {x, shorter.y(), x + half, bottom}, report);
}

}  // namespace

std::string report_drawing(const LosReport& report, Drawing::Format format) {
  Drawing drawing(format, kWidth, kHeight);
  draw_first_page(drawing, report);
  if (format == Drawing::Format::kPdf) {
    drawing.new_page();
    draw_second_page(drawing, report);
  }
  return drawing.finish();
}

}  // namespace itin::profile
