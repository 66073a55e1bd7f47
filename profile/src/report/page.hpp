// The parts of a printed page: title, headline, columns of tables, facts.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drawing/drawing.hpp"
#include "report/chart_frame.hpp"
#include "report/tables.hpp"

namespace itin::profile {

// A4 across.
inline constexpr double kWidth = 842, kHeight = 595, kMargin = 36;

inline const Lettering kPlain{8.5, kReportInk, Align::kLeft, false, 0}, kBold{8.5, kReportInk, Align::kLeft, true, 0};

/// The pages of a PDF, each with its number: "Page 1 of 3".
class Pages {
 public:
  /// `count`: how many there will be.
  explicit Pages(int count);

  Drawing& drawing() { return drawing_; }
  /// Goes on to another one.
  void begin_page();
  /// So far.
  int count() const { return page_; }

 private:
  void number();

  Drawing drawing_;
  int page_ = 1, count_;
};
/// The bytes of the PDF that `draw` draws; it is called twice, first to count the pages.
std::string numbered_pdf(const std::function<void(Pages&)>& draw);

/// Smaller where it would not fit, and cut where it must be.
void draw_title(Drawing& drawing, const std::string& title);
/// Below the title, in as many lines as it takes. Returns where the last one stands.
double draw_headline(Drawing& drawing, const std::string& text);

using Facts = std::vector<std::pair<std::string, std::string>>;  ///< name, value
inline constexpr double kFactRow = 11;
/// The facts broken into lines of the page's width: the first of each with its name.
Facts fact_lines(const Drawing& drawing, const Facts& facts);
/// Lines of facts from `y` on.
void draw_facts(Drawing& drawing, const Facts& lines, double y);

/// Sets tables one below the other in a column.
class PageColumn {
 public:
  PageColumn(Drawing& drawing, double left, double width, double top)
      : drawing_(drawing), left_(left), width_(width), y_(top) {}

  double y() const { return y_; }
  bool has_room_for(const Table& table, double bottom = kHeight - kMargin) const;
  /// How many rows of such a table fit.
  std::size_t rows_that_fit(const Table& table, double bottom) const;
  void set(const Table& table);

 private:
  std::vector<std::string> note_lines(const Table& table) const;
  std::vector<double> column_widths(const Table& table) const;
  void row(const std::vector<std::string>& cells, const std::vector<double>& widths, const Lettering& lettering);

  Drawing& drawing_;
  double left_, width_, y_;
};

}  // namespace itin::profile
