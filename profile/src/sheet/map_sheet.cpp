#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <profile/map_sheet.hpp>

#include "drawing/drawing.hpp"
#include "drawing/palette.hpp"
#include "sheet/map_frame.hpp"
#include "sheet/map_page.hpp"
#include "sheet/paper.hpp"
#include "sheet/side_panel.hpp"

namespace itin::profile {

namespace {

/// The longer side of a picture's frame, points, and the coarsest that its letters can be read at.
constexpr double kPictureFrame = 560, kLeastPixelsPerPoint = 1.4;

double pixels_per_point_of(int pixels) {
  return std::max(kLeastPixelsPerPoint, pixels / kPictureFrame);
}

/// Draws the map, which shows this ground, and the panel beside it.
void draw(const MapSheet& sheet, const Paper& paper, const Box& ground, Drawing& drawing) {
  drawing.rectangle({0, 0, paper.width, paper.height}, kPaper);
  MapFrame map(drawing, paper, ground);
  map.draw(sheet);
  SidePanel(drawing, paper, sheet, 1000 * kPointsPerMillimetre / map.points_per_metre(), map.left_out()).draw();
}

/// The height of a panel that leaves nothing out, and has room for a line about names.
double panel_height(const MapSheet& sheet, const Paper& picture, double pixels_per_point) {
  constexpr double kEndless = 1e5;
  const Paper tall = with_panel(picture, kEndless);
  Drawing scratch(Drawing::Format::kPixels, 1, 1, pixels_per_point);
  const double points_per_metre = picture.frame.width() / sheet.area.width();
  SidePanel panel(scratch, tall, sheet, 1000 * kPointsPerMillimetre / points_per_metre, left_out_text(1, 1));
  panel.draw();
  return panel.height();
}

MapPicture drawn_picture(const MapSheet& sheet, int pixels, Drawing::Format format) {
  const double pixels_per_point = pixels_per_point_of(pixels);
  Paper picture = picture_of(sheet.area, pixels, pixels_per_point);
  picture = with_panel(picture, panel_height(sheet, picture, pixels_per_point));
  Drawing drawing(format, picture.width, picture.height, pixels_per_point);
  draw(sheet, picture, sheet.area, drawing);
  const auto whole = [&](double points) { return static_cast<int>(std::lround(points * pixels_per_point)); };
  return {whole(picture.width), whole(picture.height), drawing.finish()};
}

}  // namespace

double scale_of(const MapSheet& sheet) {
  return scale_within(paper_of(sheet.paper).frame, sheet);
}

Box ground_in_frame(const MapSheet& sheet) {
  return ground_in(paper_of(sheet.paper).frame, sheet.area, scale_of(sheet));
}

void require_sheet_format(const std::string& path) {
  const auto format = Drawing::format_of(path);
  // Cairo numbers the pictures in an SVG over a whole process: equal sheets would not be equal files.
  if (!format || *format == Drawing::Format::kSvg)
    throw InputError(fmt::format("{}: a map sheet ends in .pdf or .png", path));
}

std::string draw_map_sheet(const MapSheet& sheet, const std::string& path) {
  require_sheet_format(path);
  const Paper paper = paper_of(sheet.paper);
  Drawing drawing(*Drawing::format_of(path), paper.width, paper.height, kPixelsPerPointOfSheets);
  draw_map_page(drawing, sheet);
  return drawing.finish();
}

void draw_map_page(Drawing& drawing, const MapSheet& sheet) {
  draw(sheet, paper_of(sheet.paper), ground_in_frame(sheet), drawing);
}

MapPicture draw_map_picture(const MapSheet& sheet, int pixels) {
  return drawn_picture(sheet, pixels, Drawing::Format::kPixels);
}

std::string draw_map_png(const MapSheet& sheet, int pixels) {
  return drawn_picture(sheet, pixels, Drawing::Format::kPng).rgb;
}

int void_stripe_pixels(int pixels) {
  return static_cast<int>(
      std::lround(kVoidStripePixels * kSheetPixelMm * kPointsPerMillimetre * pixels_per_point_of(pixels)));
}

}  // namespace itin::profile
