// The parts of a printed page: title, headline, columns of tables, facts.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drawing/drawing.hpp"
#include "report/charts/chart_frame.hpp"
#include "report/tables/tables.hpp"

namespace itin::profile {

// The size is A4 in landscape.
inline constexpr double kWidth = 842, kHeight = 595, kMargin = 36;
inline constexpr double kBelowTitle = 62;  ///< where a page begins that has no headline

inline const Lettering kPlain{8.5, kReportInk, Align::kLeft, false, 0}, kBold{8.5, kReportInk, Align::kLeft, true, 0};

/// The pages of a PDF, each with its number: "Page 1 of 3".
class Pages {
 public:
  /// `count` is the number of pages that there will be.
  explicit Pages(int count);

  Drawing& drawing() { return drawing_; }
  /// Goes on to another page.
  void begin_page();
  /// Goes on to a page with a map, made for A4; does nothing where it is null.
  void add_map(const MapSheet* map);
  /// The number of pages so far.
  int count() const { return page_; }

 private:
  void number();

  Drawing drawing_;
  int page_ = 1, count_;
};
/// Returns the bytes of the PDF that `draw` draws; it is called twice, first to count the pages.
std::string numbered_pdf(const std::function<void(Pages&)>& draw);

/// Draws a title, smaller where it would not fit, and cut where it must be.
void draw_title(Drawing& drawing, const std::string& title);
/// Draws text below the title, in as many lines as it takes. Returns where the last one stands.
double draw_headline(Drawing& drawing, const std::string& text);

using Facts = std::vector<std::pair<std::string, std::string>>;  ///< name, value
inline constexpr double kFactRow = 11;
/// Breaks the facts into lines of the page's width; the first line of each has its name.
Facts fact_lines(const Drawing& drawing, const Facts& facts);
/// Draws lines of facts from `y` on.
void draw_facts(Drawing& drawing, const Facts& lines, double y);

/// Sets tables one below the other in a column.
class PageColumn {
 public:
  PageColumn(Drawing& drawing, double left, double width, double top)
      : drawing_(drawing), left_(left), width_(width), y_(top) {}

  double y() const { return y_; }
  /// Leaves what is above for something else.
  void go_on_at(double y) { y_ = y; }
  bool has_room_for(const Table& table, double bottom = kHeight - kMargin) const;
  /// The number of the table's rows that fit.
  std::size_t rows_that_fit(const Table& table, double bottom) const;
  void set(const Table& table);
  /// Sets as many rows of a longer table as fit above `bottom`, `from` the first. Returns the number of the next row.
  std::size_t set_rows(const Table& table, std::size_t from, double bottom = kHeight - kMargin);

 private:
  std::vector<std::string> note_lines(const Table& table) const;
  std::vector<double> column_widths(const Table& table) const;
  /// The cells of a row in lines of their columns' widths.
  std::vector<std::vector<std::string>> cell_lines(const std::vector<std::string>& cells,
                                                   const std::vector<double>& widths, const Lettering& lettering) const;
  double row_height(const std::vector<std::string>& cells, const std::vector<double>& widths,
                    const Lettering& lettering) const;
  void row(const std::vector<std::string>& cells, const std::vector<double>& widths, const Lettering& lettering);

  Drawing& drawing_;
  double left_, width_, y_;
};

}  // namespace itin::profile
