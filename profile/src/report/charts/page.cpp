#include "report/charts/page.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sheet/map_page.hpp"

namespace itin::profile {

namespace {

/// The distance of a page's number from the lower edge: below the frame of a map, which fills its page.
constexpr double kNumberAbove = 13;
constexpr double kFactName = 76, kTitleRow = 16, kRow = 11.5, kNoteRow = 10,
                 kCellLine = 9.5;  ///< the distance of lines within a cell

const Lettering kHeadline{10, kReportInk, Align::kLeft, false, 0}, kNote{7.5, kReportGrey, Align::kLeft, false, 0},
    kFact{8, kReportGrey, Align::kLeft, false, 0};

}  // namespace

Pages::Pages(int count) : drawing_(Drawing::Format::kPdf, kWidth, kHeight), count_(count) {
  number();
}

void Pages::begin_page() {
  drawing_.new_page();
  ++page_;
  number();
}

void Pages::add_map(const MapSheet* map) {
  if (map == nullptr) return;
  drawing_.new_page();
  ++page_;
  draw_map_page(drawing_, *map);
  number();
}

void Pages::number() {
  drawing_.text({kWidth - kMargin, kHeight - kNumberAbove}, fmt::format("Page {} of {}", page_, count_),
                {7.5, kReportGrey, Align::kRight, false, 0});
}

std::string numbered_pdf(const std::function<void(Pages&)>& draw) {
  Pages counted(0);
  draw(counted);
  Pages pages(counted.count());
  draw(pages);
  return pages.drawing().finish();
}

void draw_title(Drawing& drawing, const std::string& title) {
  Lettering lettering{16, kReportInk, Align::kLeft, true, 0};
  const double width = kWidth - 2 * kMargin;
  while (lettering.size > 10 && drawing.text_width(title, lettering) > width) lettering.size -= 1;
  drawing.text({kMargin, 46}, drawing.fitted(title, width, lettering), lettering);
}

double draw_headline(Drawing& drawing, const std::string& text) {
  double y = 50;
  for (const std::string& line : drawing.lines(text, kWidth - 2 * kMargin, kHeadline))
    drawing.text({kMargin, y += 13}, line, kHeadline);
  return y;
}

Facts fact_lines(const Drawing& drawing, const Facts& facts) {
  Facts lines;
  for (const auto& [name, value] : facts) {
    std::string before = name;
    for (std::string& line : drawing.lines(value, kWidth - 2 * kMargin - kFactName, kFact))
      lines.emplace_back(std::exchange(before, ""), std::move(line));
  }
  return lines;
}

void draw_facts(Drawing& drawing, const Facts& lines, double y) {
  for (const auto& [name, line] : lines) {
    drawing.text({kMargin, y}, name, {8, kReportGrey, Align::kLeft, true, 0});
    drawing.text({kMargin + kFactName, y}, line, kFact);
    y += kFactRow;
  }
}

bool PageColumn::has_room_for(const Table& table, double bottom) const {
  return table.rows.size() <= rows_that_fit(table, bottom);
}

std::size_t PageColumn::rows_that_fit(const Table& table, double bottom) const {
  const std::vector<double> widths = column_widths(table);
  double rest = bottom - y_ - kTitleRow - (table.header.empty() ? 0 : row_height(table.header, widths, kBold)) -
                kNoteRow * static_cast<double>(note_lines(table).size());
  std::size_t rows = 0;
  for (const auto& cells : table.rows) {
    rest -= row_height(cells, widths, kPlain);
    if (rest < 0) break;
    ++rows;
  }
  return rows;
}

void PageColumn::set(const Table& table) {
  drawing_.text({left_, y_ + 10}, table.title, {10, kReportInk, Align::kLeft, true, 0});
  y_ += kTitleRow;
  const Point2 rule[] = {{left_, y_}, {left_ + width_, y_}};
  drawing_.polyline(rule, {kReportGrey, 0.6, {}});
  const std::vector<double> widths = column_widths(table);
  if (!table.header.empty()) row(table.header, widths, kBold);
  for (const auto& cells : table.rows) row(cells, widths, kPlain);
  for (const std::string& line : note_lines(table)) {
    y_ += kNoteRow;
    drawing_.text({left_, y_}, line, kNote);
  }
  y_ += 16;
}

std::size_t PageColumn::set_rows(const Table& table, std::size_t from, double bottom) {
  constexpr std::size_t kMostOnPage = 60;
  Table part{table.title + (from == 0 ? "" : ", continued"), table.header, {}, table.note};
  const std::size_t most = std::min(table.rows.size(), from + kMostOnPage);
  part.rows.assign(table.rows.begin() + static_cast<std::ptrdiff_t>(from),
                   table.rows.begin() + static_cast<std::ptrdiff_t>(most));
  part.rows.resize(std::min(part.rows.size(), std::max<std::size_t>(rows_that_fit(part, bottom), 1)));
  set(part);
  return from + part.rows.size();
}

std::vector<std::string> PageColumn::note_lines(const Table& table) const {
  if (table.note.empty()) return {};
  return drawing_.lines(table.note, width_, kNote);
}

/// The widths that the columns' texts need. Where they are too wide together, the widest give way.
std::vector<double> PageColumn::column_widths(const Table& table) const {
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

std::vector<std::vector<std::string>> PageColumn::cell_lines(const std::vector<std::string>& cells,
                                                             const std::vector<double>& widths,
                                                             const Lettering& lettering) const {
  constexpr std::size_t kMostLines = 4;
  std::vector<std::vector<std::string>> lines;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double width = widths[i] - 3;
    std::vector<std::string>& cell = lines.emplace_back(drawing_.lines(cells[i], width, lettering));
    if (cell.size() <= kMostLines) continue;
    cell.resize(kMostLines);
    cell.back() = drawing_.fitted(cell.back() + "\xE2\x80\xA6", width, lettering);
  }
  return lines;
}

double PageColumn::row_height(const std::vector<std::string>& cells, const std::vector<double>& widths,
                              const Lettering& lettering) const {
  std::size_t most = 1;
  for (const auto& lines : cell_lines(cells, widths, lettering)) most = std::max(most, lines.size());
  return kRow + kCellLine * static_cast<double>(most - 1);
}

void PageColumn::row(const std::vector<std::string>& cells, const std::vector<double>& widths,
                     const Lettering& lettering) {
  double x = left_;
  const std::vector<std::vector<std::string>> all = cell_lines(cells, widths, lettering);
  for (std::size_t i = 0; i < all.size(); ++i) {
    double y = y_ + kRow;
    for (const std::string& line : all[i]) {
      drawing_.text({x, y}, line, lettering);
      y += kCellLine;
    }
    x += widths[i];
  }
  y_ += row_height(cells, widths, lettering);
}

}  // namespace itin::profile
