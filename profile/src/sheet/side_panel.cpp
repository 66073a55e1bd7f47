#include "sheet/side_panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/counted.hpp>
#include <itin/round_length.hpp>

#include "drawing/palette.hpp"
#include "sheet/map_symbols.hpp"

namespace itin::profile {

SidePanel::SidePanel(Drawing& drawing, const Paper& paper, const MapSheet& sheet, double scale,
                     std::string below_legend)
    : drawing_(drawing),
      paper_(paper),
      sheet_(sheet),
      scale_(scale),
      below_legend_(std::move(below_legend)),
      left_(paper.panel.xmin + 3 * kPointsPerMillimetre * paper.type),
      right_(paper.panel.xmax - 3 * kPointsPerMillimetre * paper.type),
      y_(paper.panel.ymin) {}

void SidePanel::draw() {
  draw_heading();
  draw_legend(paper_.panel.ymax - foot_height() - notes_height() - 24 * kPointsPerMillimetre * paper_.type);
  draw_scale();
  draw_notes();
  draw_foot();
  drawing_.outline(paper_.panel, {kInk, 0.8 * paper_.type, {}});
}

double SidePanel::foot_height() const {
  return (has_date() ? 17 : 6) * kPointsPerMillimetre * paper_.type;
}

double SidePanel::height() const {
  return y_ - paper_.panel.ymin + foot_height();
}

void SidePanel::rule() {
  y_ += 1.5 * kPointsPerMillimetre * paper_.type;
  if (!measuring_)
    drawing_.polyline(std::array{Point2{paper_.panel.xmin, y_}, Point2{paper_.panel.xmax, y_}},
                      {kInk, 0.4 * paper_.type, {}});
  y_ += 1 * kPointsPerMillimetre * paper_.type;
}

void SidePanel::paragraph(const std::string& text, double size, bool bold) {
  const Lettering lettering{.size = paper_.letters(size), .colour = kInk, .bold = bold};
  for (const std::string& line : drawing_.lines(text, right_ - left_, lettering)) {
    y_ += 1.28 * lettering.size;
    if (!measuring_) drawing_.text({left_, y_}, line, lettering);
  }
  y_ += 0.35 * lettering.size;
}

void SidePanel::heading(const std::string& text, std::size_t most_lines, double size, bool bold) {
  const Lettering full{.size = size * paper_.type, .colour = kInk, .bold = bold};
  paragraph(text, drawing_.lettering_for(text, right_ - left_, most_lines, full).size / paper_.type, bold);
}

void SidePanel::draw_heading() {
  y_ += 1.5 * kPointsPerMillimetre * paper_.type;
  if (!sheet_.title.project.empty()) heading(sheet_.title.project, 2, 9.5, false);
  heading(sheet_.title.title, 4, 12, true);
  rule();
}

void SidePanel::draw_key(const SheetKey& key) {
  const double row = 4.4 * kPointsPerMillimetre * paper_.type, width = 7 * kPointsPerMillimetre * paper_.type,
               x = left_, middle = y_ + row / 2;
  if (key.sample == SheetKey::Sample::kHeading) return paragraph(key.text, 7.5, true);
  const Box patch{x, middle - 0.36 * row, x + width, middle + 0.36 * row};
  draw_sample(drawing_, key, patch, paper_.type);
  const Lettering lettering{.size = paper_.letters(7), .colour = kInk};
  const double text = x + width + 2 * kPointsPerMillimetre * paper_.type;
  double baseline = middle + 0.36 * lettering.size;
  for (const std::string& line : drawing_.lines(key.text, right_ - text, lettering)) {
    drawing_.text({text, baseline}, line, lettering);
    baseline += 1.2 * lettering.size;
  }
  y_ = std::max(y_ + row, baseline - 0.8 * lettering.size);
}

void SidePanel::draw_legend(double bottom) {
  std::size_t left = sheet_.legend.size();
  for (const SheetKey& key : sheet_.legend) {
    if (y_ + 8 * kPointsPerMillimetre * paper_.type > bottom && left > 1) {
      paragraph(fmt::format("and {} more", left), 7, false);
      break;
    }
    draw_key(key);
    --left;
  }
  if (!below_legend_.empty()) paragraph(below_legend_, 6.3, false);
  rule();
}

void SidePanel::draw_scale() {
  const double top = y_, points_per_metre = 1000 * kPointsPerMillimetre / scale_;
  const double length = round_length(46 * kPointsPerMillimetre * paper_.type / points_per_metre),
               bar = length * points_per_metre;
  const double unit = length >= 2000 ? 1000 : 1;
  const Lettering small{.size = 6.5 * paper_.type, .colour = kInk, .align = Align::kCentre};
  if (!paper_.name.empty())
    drawing_.text(
        {left_, y_ + 9 * paper_.type},
        fmt::format("Scale 1:{} at {}", grouped(static_cast<std::uint64_t>(std::nearbyint(scale_))), paper_.name),
        {.size = 8.5 * paper_.type, .colour = kInk, .bold = true});
  y_ += 13 * paper_.type;
  constexpr int kParts = 4;
  const double left = left_ + 2 * kPointsPerMillimetre * paper_.type, height = 1.6 * kPointsPerMillimetre * paper_.type;
  for (int i = 0; i < kParts; ++i)
    drawing_.rectangle({left + bar * i / kParts, y_, left + bar * (i + 1) / kParts, y_ + height},
                       i % 2 == 0 ? kInk : kPaper);
  drawing_.outline({left, y_, left + bar, y_ + height}, {kInk, 0.4 * paper_.type, {}});
  for (const int i : {0, 2, 4})
    drawing_.text({left + bar * i / kParts, y_ + height + 8 * paper_.type},
                  fmt::format("{:g}{}", length * i / kParts / unit,
                              i < kParts ? ""
                              : unit > 1 ? " km"
                                         : " m"),
                  small);
  y_ += height + 10 * paper_.type;
  draw_north({right_ - 6 * kPointsPerMillimetre * paper_.type, top + 14 * kPointsPerMillimetre * paper_.type});
  y_ = std::max(y_, top + 16 * kPointsPerMillimetre * paper_.type);
  rule();
}

void SidePanel::draw_north(Point2 foot) {
  const double u = kPointsPerMillimetre * paper_.type;
  const Point2 tip{foot.x, foot.y - 10 * u}, notch{foot.x, foot.y - 2.5 * u};
  drawing_.polygon(std::array{tip, Point2{foot.x - 2.4 * u, foot.y}, notch}, kInk);
  drawing_.polyline(std::array{tip, Point2{foot.x + 2.4 * u, foot.y}, notch}, {kInk, 0.4 * paper_.type, {}});
  drawing_.text({foot.x, tip.y - 1 * u}, "N", {.size = 8 * paper_.type, .colour = kInk, .align = Align::kCentre});
  drawing_.text({foot.x - 4 * u, foot.y}, "grid", {.size = 5 * paper_.type, .colour = kFaint, .align = Align::kRight});
}

void SidePanel::draw_notes() {
  const TitleBlock& t = sheet_.title;
  if (!t.statement.empty()) paragraph(t.statement, 7, true);
  for (const auto& [name, value] : t.facts) paragraph(fmt::format("{}: {}", name, value), 6.3, false);
  std::string sources;
  for (const std::string& source : t.sources) sources += (sources.empty() ? "" : "; ") + source;
  if (!sources.empty()) paragraph("Sources: " + sources, 6.3, false);
  rule();
}

double SidePanel::notes_height() {
  const double before = y_;
  measuring_ = true;
  draw_notes();
  measuring_ = false;
  const double height = y_ - before;
  y_ = before;
  return height;
}

void SidePanel::draw_foot() {
  const TitleBlock& t = sheet_.title;
  const double u = paper_.type;
  const double y = paper_.panel.ymax;
  const Lettering small{.size = 6.3 * u, .colour = kFaint}, plain{.size = 8.5 * u, .colour = kInk, .bold = true};
  drawing_.text({left_, y - 5 * u}, drawing_.fitted("Drawn by itin " ITIN_VERSION, right_ - left_, small), small);
  if (!has_date()) return;
  drawing_.polyline(std::array{Point2{paper_.panel.xmin, y - 36 * u}, Point2{paper_.panel.xmax, y - 36 * u}},
                    {kInk, 0.4 * u, {}});
  drawing_.text({left_, y - 27 * u}, "Date", small);
  drawing_.text({left_, y - 16 * u}, t.date, plain);
  const double middle = (left_ + right_) / 2;
  if (!t.figure.empty()) {
    drawing_.text({middle, y - 27 * u}, "Figure", small);
    drawing_.text({middle, y - 16 * u}, t.figure, plain);
  }
}

}  // namespace itin::profile
