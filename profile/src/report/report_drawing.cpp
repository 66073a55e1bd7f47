// Draws the report as pages. SVG and PNG have one page; the PDF adds that of the worst fade, tables, the trade-off
// chart, and the profile as a table.
#include <algorithm>

#include <fmt/format.h>

#include "report/charts/fade.hpp"
#include "report/charts/location_figure.hpp"
#include "report/charts/page.hpp"
#include "report/charts/sight_chart.hpp"
#include "report/charts/trade_off_chart.hpp"
#include "report/formats.hpp"
#include "report/tables/path_tables.hpp"
#include "report/tables/tables.hpp"

namespace itin::profile {

namespace {

void draw_first_page(Drawing& drawing, const LosReport& report) {
  draw_title(drawing, report.title);
  const double top = draw_headline(drawing, verdict_line(report)) + 19;
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
  const Facts facts = fact_lines(drawing, report.facts);
  const double facts_height = kFactRow * static_cast<double>(facts.size());
  draw_sight_chart(drawing, {kMargin, top + 11 * lines + 2, kWidth - kMargin, kHeight - kMargin - facts_height},
                   report);
  draw_facts(drawing, facts, kHeight - kMargin - facts_height + 12);
}

/// Draws the line over the Earth of the worst fade that a criterion asks about.
void draw_fade_page(Pages& pages, const LosReport& report) {
  const CriterionResult* fade = worst_fade(report);
  if (fade == nullptr) return;
  pages.begin_page();
  Drawing& drawing = pages.drawing();
  draw_title(drawing, report.title);
  const double top = draw_headline(drawing, fade_line(*fade, unit_of(report))) + 12;
  draw_sight_chart(drawing, {kMargin, top, kWidth - kMargin, kHeight - kMargin}, over_earth_of(report, *fade));
}

/// Draws two columns of tables per page, on as many pages as they take.
class TablePages {
 public:
  TablePages(Pages& pages, const LosReport& report) : pages_(pages), drawing_(pages.drawing()), report_(report) {
    begin_page();
  }

  void draw() {
    for (const Table& table : result_tables(report_)) place(table, table.second_column ? 1 : 0).set(table);
    if (report_.location)
      add_figure(kLeastMap, [&](const Box& area) { draw_location(drawing_, area, *report_.location); });
    if (has_trade_off(report_))
      add_figure(kLeastChart, [&](const Box& area) { draw_trade_off_chart(drawing_, area, report_); });
  }

 private:
  static constexpr double kHalf = (kWidth - 3 * kMargin) / 2, kLeastChart = 200, kLeastMap = 300, kMostFigure = 400;

  /// Draws a figure in a column with at least this room, on a page of its own where neither has it.
  template <class Draw>
  void add_figure(double least, const Draw& draw) {
    if (columns_[shorter()].y() + least > kHeight - kMargin) begin_page();
    const std::size_t i = shorter();
    const double x = left_of(i), y = columns_[i].y();
    const Box area{x, y, x + kHalf, std::min(kHeight - kMargin, y + kMostFigure)};
    draw(area);
    columns_[i].go_on_at(area.ymax);
  }

  static double left_of(std::size_t i) { return i == 0 ? kMargin : 2 * kMargin + kHalf; }
  std::size_t shorter() const { return columns_[1].y() < columns_[0].y() ? 1 : 0; }

  void begin_page() {
    pages_.begin_page();
    draw_title(drawing_, report_.title);
    columns_.clear();
    for (const std::size_t i : {0U, 1U}) columns_.emplace_back(drawing_, left_of(i), kHalf, kBelowTitle);
  }

  PageColumn& place(const Table& table, std::size_t preferred) {
    for (const std::size_t i : {preferred, 1 - preferred}) {
      if (columns_[i].has_room_for(table)) return columns_[i];
    }
    begin_page();
    return columns_[preferred];
  }

  Pages& pages_;
  Drawing& drawing_;
  const LosReport& report_;
  std::vector<PageColumn> columns_;
};

void draw_profile_pages(Pages& pages, const LosReport& report) {
  const std::optional<Table> whole = profile_table(report);
  if (!whole) return;
  for (std::size_t row = 0; row < whole->rows.size();) {
    pages.begin_page();
    draw_title(pages.drawing(), report.title);
    row = PageColumn(pages.drawing(), kMargin, kWidth - 2 * kMargin, kBelowTitle).set_rows(*whole, row);
  }
}

}  // namespace

std::string report_drawing(const LosReport& report, Drawing::Format format) {
  if (format != Drawing::Format::kPdf) {
    Drawing drawing(format, kWidth, kHeight);
    draw_first_page(drawing, report);
    return drawing.finish();
  }
  return numbered_pdf([&](Pages& pages) {
    draw_first_page(pages.drawing(), report);
    draw_fade_page(pages, report);
    TablePages(pages, report).draw();
    draw_profile_pages(pages, report);
  });
}

}  // namespace itin::profile
