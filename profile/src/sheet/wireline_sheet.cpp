#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>

#include <itin/counted.hpp>
#include <itin/error.hpp>
#include <profile/wireline_sheet.hpp>

#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"
#include "drawing/wireline_scene.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/paper.hpp"
#include "sheet/sheet_table.hpp"
#include "sheet/wireline_strip.hpp"

namespace itin::profile {

namespace {

// Sizes in millimetres and degrees; see wireline_sheet.hpp.
constexpr double kPageWidth = 841, kPageHeight = 297, kImageWidth = 820;
constexpr double kPlanarHeight = 260, kPlanarPrincipal = 812.5;
constexpr double kWeight = 1.6;
constexpr double kCylinderField = 90, kCylinderHeight = 130, kCylinderPrincipal = 522;

Drawing pdf(const std::string& path, double width_mm, double height_mm) {
  if (Drawing::format_of(path) != Drawing::Format::kPdf)
    throw InputError(fmt::format("{}: a wireline's sheet ends in .pdf", path));
  return {Drawing::Format::kPdf, width_mm * kPointsPerMillimetre, height_mm * kPointsPerMillimetre};
}

constexpr Box box_mm(double left, double top, double width, double height) {
  constexpr double k = kPointsPerMillimetre;
  return {left * k, top * k, (left + width) * k, (top + height) * k};
}

/// The place of the location map on a viewpoint's sheet.
constexpr Box kLocationFrame = box_mm(255, 16, 150, 178);

/// Draws title and facts in columns below an image, from `top` on, and the farms' names in their colours.
void draw_caption(Drawing& drawing, const Wireline& view, const WirelineSheet& sheet, const std::string& how,
                  double top_mm) {
  constexpr double k = kPointsPerMillimetre;
  const double left = (kPageWidth - kImageWidth) / 2 * k, width = kImageWidth * k;
  double y = top_mm * k;
  drawing.text({left, y + 12}, sheet.title, {.size = 13, .colour = kInk, .bold = true});
  draw_farm_names(drawing, view.query, {left + width, y + 12}, 9, 12);
  y += 24;
  const double column = width / 5;
  const Lettering lettering{.size = 8, .colour = kInk};
  double at = left, row = y;
  const double bottom = (kPageHeight - 5) * k;
  const auto add = [&](const std::string& text) {
    for (const std::string& line : drawing.lines(text, column - 14, lettering)) {
      if (row > bottom && at + 1.01 * column < left + width) row = y, at += column;
      drawing.text({at, row}, line, lettering);
      row += 10;
    }
  };
  add(how);
  for (const auto& [name, value] : sheet.facts) add(fmt::format("{}: {}", name, value));
}

std::string seen_from(double principal_mm, const char* projection, double field) {
  return fmt::format(
      "{} projection, horizontal field of view {:g}°, principal distance {:g} mm on paper of {:g} by {:g} "
      "mm: to be printed at full size and viewed flat at a comfortable arm's length.",
      projection, field, principal_mm, kPageWidth, kPageHeight);
}

}  // namespace

std::string draw_planar_sheet(const Wireline& view, const WirelineSheet& sheet, const std::string& path) {
  Drawing drawing = pdf(path, kPageWidth, kPageHeight);
  drawing.rectangle({0, 0, drawing.width(), drawing.height()}, kPaper);
  draw_strip(drawing, view,
             {StripProjection::kPlanar, box_mm((kPageWidth - kImageWidth) / 2, 4, kImageWidth, kPlanarHeight),
              kPlanarPrincipal, sheet.centre_deg, kPlanarField, kWeight});
  draw_caption(drawing, view, sheet, seen_from(kPlanarPrincipal, "Planar", kPlanarField), kPlanarHeight + 10);
  return drawing.finish();
}

std::string draw_cylindrical_sheets(const std::vector<WirelineField>& fields, const WirelineSheet& sheet,
                                    const std::string& path) {
  Drawing drawing = pdf(path, kPageWidth, kPageHeight);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const WirelineField& field = fields[i];
    const bool upper = i % 2 == 0;
    if (upper) {
      if (i > 0) drawing.new_page();
      drawing.rectangle({0, 0, drawing.width(), drawing.height()}, kPaper);
      draw_caption(drawing, fields.back().view, sheet, seen_from(kCylinderPrincipal, "Cylindrical", kCylinderField),
                   2 * kCylinderHeight + 14);
    }
    const Box frame = box_mm((kPageWidth - kImageWidth) / 2, upper ? 4 : 139.5, kImageWidth, kCylinderHeight);
    draw_strip(drawing, field.view,
               {StripProjection::kCylindrical, frame, kCylinderPrincipal, field.centre_deg, kCylinderField, kWeight});
    drawing.text({frame.xmin + 6, frame.ymin + 14}, field.label, {.size = 10, .colour = kInk, .bold = true, .rim = 2});
  }
  return drawing.finish();
}

std::vector<double> cylinder_centres(double centre_deg, int fields) {
  std::vector<double> centres;
  for (int i = 0; i < fields; ++i) centres.push_back(centre_deg + kCylinderField * (i - (fields - 1) / 2.0));
  return centres;
}

Box ground_in_location_map(const MapSheet& map) {
  return ground_in(kLocationFrame, map.area, map.scale);
}

std::string draw_viewpoint_sheet(const Wireline& view, const ViewpointSheet& sheet, const std::string& path) {
  constexpr double k = kPointsPerMillimetre, kSheetWidth = 420, kSheetHeight = 297, kSheetMargin = 10, kStripTop = 214,
                   kStrip = 63;
  Drawing drawing = pdf(path, kSheetWidth, kSheetHeight);
  drawing.rectangle({0, 0, drawing.width(), drawing.height()}, kPaper);
  const double left = kSheetMargin * k, width = 230 * k;
  double y = 16 * k;
  const Lettering title =
      drawing.lettering_for(sheet.wireline.title, width, 2, {.size = 16, .colour = kInk, .bold = true});
  for (const std::string& line : drawing.lines(sheet.wireline.title, width, title)) {
    drawing.text({left, y}, line, title);
    y += 1.2 * title.size;
  }
  y += 10 * k - 1.2 * title.size;
  const Lettering name_of_fact{.size = 9, .colour = kFaint}, plain{.size = 9, .colour = kInk};
  const double values = left + 55 * k;
  for (const auto& [name, value] : sheet.wireline.facts) {
    drawing.text({left, y}, name, name_of_fact);
    for (const std::string& line : drawing.lines(value, left + width - values, plain)) {
      drawing.text({values, y}, line, plain);
      y += 12;
    }
    y += 2;
  }
  constexpr double kLetters = 7.5 / 7, kLeastRoom = 40;
  const double bottom = kStripTop * k - 8, below = y + height_of_table(sheet.farms, kLetters) + 14;
  draw_sheet_table(drawing, sheet.farms, {left, y, left + width, bottom}, kLetters);
  if (bottom - below > kLeastRoom)
    draw_sheet_table(drawing, sheet.turbines, {left, below, left + width, bottom}, kLetters);
  Paper paper = paper_of(PaperSize::kA3);
  paper.frame = kLocationFrame;
  MapFrame map(drawing, paper, ground_in_location_map(sheet.map));
  map.draw(sheet.map);
  const std::string left_out = map.left_out();
  drawing.text({paper.frame.xmin, paper.frame.ymax + 22},
               fmt::format("Location, 1:{} at A3; grid north is up{}{}",
                           grouped(static_cast<std::uint64_t>(std::nearbyint(sheet.map.scale))),
                           left_out.empty() ? "" : "; ", left_out),
               name_of_fact);
  const double image = kSheetWidth - 2 * kSheetMargin, principal = image / (std::numbers::pi / 2);
  draw_strip(drawing, view,
             {StripProjection::kCylindrical, box_mm(kSheetMargin, kStripTop, image, kStrip), principal,
              sheet.wireline.centre_deg, kCylinderField});
  drawing.text(
      {left, (kStripTop + kStrip + 9) * k},
      fmt::format("Wireline, cylindrical, horizontal field of view {:g}°, principal distance {:.0f} mm at A3: for "
                  "orientation. Sheets of {:g} by {:g} mm are separate: planar, {:g}°, principal distance {:g} mm, and "
                  "cylindrical, {:g}°, principal distance {:g} mm.",
                  kCylinderField, principal, kPageWidth, kPageHeight, kPlanarField, kPlanarPrincipal, kCylinderField,
                  kCylinderPrincipal),
      name_of_fact);
  return drawing.finish();
}

}  // namespace itin::profile
