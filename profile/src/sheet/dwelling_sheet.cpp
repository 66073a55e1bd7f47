#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <profile/dwelling_sheet.hpp>

#include "drawing/calendar_chart.hpp"
#include "drawing/palette.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/map_symbols.hpp"
#include "sheet/paper.hpp"
#include "sheet/sheet_table.hpp"

namespace itin::profile {

namespace {

/// A part of the sheet, in millimetres of A3; larger paper has everything larger.
struct Part {
  double left, top, width, height;
};
constexpr double kA3Width = 420;
constexpr Part kHeadingPart{10, 10, 245, 10}, kFactsPart{10, 23, 178, 62}, kPlanPart{194, 26, 61, 56},
    kTablesPart{10, 88, 245, 80}, kMapPart{266, 14, 140, 128}, kKeysPart{266, 146, 144, 22},
    kCalendarPart{10, 171, 400, 112}, kFootPart{10, 284.5, 400, 6};

class DwellingPage {
 public:
  DwellingPage(const DwellingSheet& sheet, Drawing& drawing, const Paper& paper)
      : sheet_(sheet),
        drawing_(drawing),
        paper_(paper),
        millimetre_(paper.width / kA3Width),
        type_(millimetre_ / kPointsPerMillimetre) {}

  void draw() {
    drawing_.rectangle({0, 0, paper_.width, paper_.height}, kPaper);
    draw_heading();
    draw_facts();
    if (!sheet_.plan.area.empty()) draw_plan();
    draw_tables();
    draw_map();
    draw_heading_of_calendar();
    Box calendar = box(kCalendarPart);
    calendar.ymin += 13 * type_;
    draw_calendar(drawing_, calendar, sheet_.calendar, type_);
    draw_foot();
  }

  static Box box_on(const Paper& paper, const Part& part) {
    const double k = paper.width / kA3Width;
    return {part.left * k, part.top * k, (part.left + part.width) * k, (part.top + part.height) * k};
  }

 private:
  Box box(const Part& part) const { return box_on(paper_, part); }

  /// The paper of a map in this part, whose letters and symbols are as large as those beside it.
  Paper paper_of_map(const Part& part) const {
    Paper paper = paper_;
    paper.frame = box(part), paper.type = type_;
    return paper;
  }

  void draw_heading() {
    const Box at = box(kHeadingPart);
    const Lettering title =
        drawing_.lettering_for(sheet_.title, at.width(), 1, {.size = 16 * type_, .colour = kInk, .bold = true});
    drawing_.text({at.xmin, at.ymin + 14 * type_}, drawing_.fitted(sheet_.title, at.width(), title), title);
    drawing_.text({at.xmin, at.ymin + 26 * type_}, drawing_.fitted(sheet_.map.title.project, at.width(), faint(9)),
                  faint(9));
  }

  void draw_facts() {
    const Box at = box(kFactsPart);
    const double values = at.xmin + 46 * millimetre_;
    const Lettering plain{.size = 8 * type_, .colour = kInk};
    double y = at.ymin;
    for (const auto& [name, value] : sheet_.facts) {
      if (y + 10 * type_ > at.ymax) return;
      drawing_.text({at.xmin, y + 9 * type_}, name, faint(8));
      for (const std::string& line : drawing_.lines(value, at.xmax - values, plain)) {
        drawing_.text({values, y + 9 * type_}, line, plain);
        y += 10 * type_;
      }
      y += 1.5 * type_;
    }
  }

  void draw_plan() {
    const Paper paper = paper_of_map(kPlanPart);
    const double scale = scale_within(paper.frame, sheet_.plan);
    MapFrame(drawing_, paper, ground_in(paper.frame, sheet_.plan.area, scale)).draw(sheet_.plan);
    drawing_.text({paper.frame.xmin, paper.frame.ymin - 3 * type_},
                  fmt::format("Facades by their numbers, {}", scale_text(scale)), faint(7.5));
  }

  /// The facades have what room the turbines leave, and half of it at least.
  void draw_tables() {
    const double gap = 4 * millimetre_;
    Box facades = box(kTablesPart), turbines = facades;
    const double of_turbines = std::min(height_of_table(sheet_.turbines, type_), (facades.height() - gap) / 2);
    turbines.ymin = std::min(facades.ymin + height_of_table(sheet_.facades, type_) + gap, facades.ymax - of_turbines);
    facades.ymax = turbines.ymin - gap;
    draw_sheet_table(drawing_, sheet_.facades, facades, type_);
    draw_sheet_table(drawing_, sheet_.turbines, turbines, type_);
  }

  void draw_map() {
    const Paper paper = paper_of_map(kMapPart);
    MapFrame map(drawing_, paper, ground_in_dwelling_map(sheet_.map));
    map.draw(sheet_.map);
    draw_keys(map.left_out());
  }

  void draw_keys(const std::string& left_out) {
    const Box at = box(kKeysPart);
    const Lettering lettering{.size = 7 * type_, .colour = kInk};
    const double row = 9.5 * type_, sample = 7 * millimetre_, text = sample + 2 * millimetre_;
    double y = at.ymin;
    for (const SheetKey& key : sheet_.map.legend) {
      draw_sample(drawing_, key, {at.xmin, y + 1 * type_, at.xmin + sample, y + row - 1 * type_}, type_);
      drawing_.text({at.xmin + text, y + 7 * type_}, drawing_.fitted(key.text, at.width() - text, lettering),
                    lettering);
      y += row;
    }
    const std::string names = left_out.empty() ? "" : "; " + left_out;
    drawing_.text({at.xmin, y + 8 * type_},
                  drawing_.fitted(fmt::format("{}; grid north is up{}", scale_text(sheet_.map.scale), names),
                                  at.width(), faint(7)),
                  faint(7));
  }

  void draw_heading_of_calendar() {
    const Box at = box(kCalendarPart);
    const Lettering bold{.size = 9 * type_, .colour = kInk, .bold = true};
    drawing_.text({at.xmin, at.ymin + 8 * type_}, sheet_.calendar.title, bold);
    const double from = at.xmin + drawing_.text_width(sheet_.calendar.title, bold) + 8 * type_;
    drawing_.text({from, at.ymin + 8 * type_}, drawing_.fitted(sheet_.calendar.note, at.xmax - from, faint(7.5)),
                  faint(7.5));
  }

  void draw_foot() {
    const TitleBlock& block = sheet_.map.title;
    std::string text = "Drawn by itin " ITIN_VERSION;
    const auto add = [&](const char* name, const std::string& value) {
      if (!value.empty()) text += fmt::format("; {}{}", name, value);
    };
    add("date: ", block.date), add("figure: ", block.figure);
    for (const std::string& source : block.sources) add(&source == &block.sources.front() ? "sources: " : "", source);
    const Box at = box(kFootPart);
    std::vector<std::string> lines = drawing_.lines(text, at.width(), faint(6.5));
    if (lines.size() > 2) {
      for (std::size_t i = 2; i < lines.size(); ++i) lines[1] += " " + lines[i];
      lines.resize(2);
    }
    double y = at.ymin + 6.5 * type_;
    for (const std::string& line : lines) {
      drawing_.text({at.xmin, y}, drawing_.fitted(line, at.width(), faint(6.5)), faint(6.5));
      y += 8 * type_;
    }
  }

  Lettering faint(double size) const { return {.size = size * type_, .colour = kFaint}; }

  std::string scale_text(double scale) const {
    return fmt::format("1:{} at {}", grouped(static_cast<std::uint64_t>(std::nearbyint(scale))), paper_.name);
  }

  const DwellingSheet& sheet_;
  Drawing& drawing_;
  const Paper& paper_;
  double millimetre_;  ///< points for a millimetre of A3
  double type_;        ///< factor for letters
};

Box frame_of_map(const MapSheet& map) {
  return DwellingPage::box_on(paper_of(map.paper), kMapPart);
}

}  // namespace

double scale_of_dwelling_map(const MapSheet& map) {
  return scale_within(frame_of_map(map), map);
}

Box ground_in_dwelling_map(const MapSheet& map) {
  return ground_in(frame_of_map(map), map.area, map.scale);
}

std::string draw_dwelling_sheet(const DwellingSheet& sheet, const std::string& path) {
  require_sheet_format(path);
  const Paper paper = paper_of(sheet.map.paper);
  Drawing drawing(*Drawing::format_of(path), paper.width, paper.height, kPixelsPerPointOfSheets);
  DwellingPage(sheet, drawing, paper).draw();
  return drawing.finish();
}

}  // namespace itin::profile
