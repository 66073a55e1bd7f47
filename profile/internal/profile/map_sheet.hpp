// A map on a sheet of paper, to scale: layers in a frame with the grid's references, and beside it a panel with title
// block, legend, scale bar, north, statement, facts and sources.
//
//   profile::MapSheet sheet;
//   sheet.area = {280000, 170000, 330000, 215000}, sheet.crs_wkt = store.metadata().crs_wkt;
//   sheet.layers = {profile::SheetCells{grid, colours}, profile::SheetMarks{...}};
//   sheet.title.title = "Zone of theoretical visibility: blade tips";
//   write("ztv.pdf", profile::draw_map_sheet(sheet, "ztv.pdf"));
//
// A sheet knows nothing of what its layers mean: it draws viewsheds, zones and sites alike.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/raster.hpp>
#include <profile/sheet_choice.hpp>

namespace itin::profile {

/// The cells of a grid, row by row from the north-west, each in its colour.
struct SheetCells {
  RasterGrid grid;
  std::vector<Rgba> colours;
};

/// Areas of one colour. Each has rings, read by the even-odd rule.
struct SheetAreas {
  std::vector<std::vector<std::vector<Point2>>> areas;
  Rgba colour;
};

/// A label stands where the line is farthest north, for there a contour runs from west to east, or else about its
/// middle.
struct SheetLine {
  std::vector<Point2> points;
  std::string label;
  bool label_in_middle = false;
};
struct SheetLines {
  std::vector<SheetLine> lines;
  Rgba colour;
  double width_mm = 0.2;
  bool dashed = false;
};

enum class SheetSymbol { kTurbine, kViewpoint, kMast, kRelay, kExistingMast, kHub, kDot };

/// A mark with its label. Labels that would cover another label or a mark are left out, first those of later marks, and
/// counted below the legend.
struct SheetMark {
  Point2 at;
  std::string label;
};
struct SheetMarks {
  SheetSymbol symbol = SheetSymbol::kMast;
  Rgba colour;
  std::vector<SheetMark> marks;
};

using SheetLayer = std::variant<SheetCells, SheetAreas, SheetLines, SheetMarks>;

/// The side of a pixel of the pictures that are made for sheets: relief, and stripes where there is no ground.
inline constexpr double kSheetPixelMm = 0.25;
/// The distance between these stripes.
inline constexpr int kVoidStripePixels = 10;

/// One row of the legend. The sample before the text looks as it does on the map.
struct SheetKey {
  enum class Sample { kPatch, kVoid, kLine, kDashes, kMark, kHeading };
  Sample sample = Sample::kPatch;
  std::vector<Rgba>
      colours;  ///< one, or in a patch several side by side; none for a heading or where there is no ground
  std::string text;
  SheetSymbol symbol = SheetSymbol::kMast;  ///< the symbol that is drawn for a mark
};

struct TitleBlock {
  std::string project;                                     ///< may be empty
  std::string title;                                       ///< what the map shows
  std::string figure;                                      ///< the figure's number; may be empty
  std::string date;                                        ///< as it is to be printed
  std::string statement;                                   ///< what the result takes into account and what it does not
  std::vector<std::pair<std::string, std::string>> facts;  ///< name, value
  std::vector<std::string> sources;                        ///< where the data comes from, with licences
};

struct MapSheet {
  PaperSize paper = PaperSize::kA3;  ///< as the scale, not of pictures
  double scale = 0;                  ///< 1 : scale; 0: the largest of the usual ones at which the frame holds `area`
  Box area;                          ///< in the middle of the frame, metres
  std::string crs_wkt;               ///< the CRS whose grid is marked; the National Grid is marked by its letters
  std::vector<SheetLayer> layers;    ///< the lowest first
  std::vector<SheetKey> legend;
  TitleBlock title;
};

/// The scale at which a sheet is drawn. Throws InputError for a given scale at which the area does not fit the frame.
double scale_of(const MapSheet& sheet);
/// The ground inside the frame at that scale: what layers may fill. Throws as scale_of() does.
Box ground_in_frame(const MapSheet& sheet);

/// Throws InputError unless the name ends in .pdf or .png.
void require_sheet_format(const std::string& path);

/// Returns the bytes of a file: .pdf or .png (200 dots per inch) by the name's ending. Equal sheets give equal bytes.
/// Throws InputError for another ending, and for a scale at which the area is larger than the frame.
std::string draw_map_sheet(const MapSheet& sheet, const std::string& path);

/// A picture: red, green and blue of 8 bits, row by row from the north-west.
struct MapPicture {
  int width = 0, height = 0;
  std::string rgb;
};
/// Draws the map for a screen instead: `area` fills the frame, whose longer side has so many pixels, and the panel is
/// as high as its content. There is no paper, and no scale in figures.
MapPicture draw_map_picture(const MapSheet& sheet, int pixels);
/// Returns the same picture as the bytes of a PNG.
std::string draw_map_png(const MapSheet& sheet, int pixels);
/// The distance of the stripes where there is no ground, pixels of such a picture.
int void_stripe_pixels(int pixels);

/// Returns the elements of an SVG that draw a mark of this height about the origin.
std::string symbol_svg(SheetSymbol symbol, const Rgba& colour, double size);
/// Returns the elements of an SVG that draw the sample of a legend's row, which is no heading.
std::string sample_svg(const SheetKey& key, double width, double height);

}  // namespace itin::profile
