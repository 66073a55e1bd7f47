#include "output/web_layers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <itin/base64.hpp>
#include <itin/filling_grid.hpp>
#include <itin/svg_path.hpp>
#include <profile/averaged_cells.hpp>
#include <viewshed/picture_bytes.hpp>

namespace itin::cli {

namespace {

constexpr int kJpegQuality = 80;
constexpr double kPathUnits = 10 * kWebGroundPixels;  ///< the frame's width in the units of a path
constexpr SvgPrecision kTenthOfAPixel{.tolerance = 1, .step = 1};
constexpr double kPixelsPerMillimetre = 96 / 25.4, kMarkPixels = 14;
constexpr Rgba kNoGround{237, 237, 242, 255};

/// Returns the cells themselves or, where they are many, as many as a page shows.
profile::SheetCells few_enough(const profile::SheetCells& cells) {
  const RasterGrid& grid = cells.grid;
  const std::int64_t longer = std::max(grid.columns(), grid.rows());
  if (longer <= kWebMostCells) return cells;
  const auto fewer = [&](std::int64_t count) { return std::max<std::int64_t>(1, count * kWebMostCells / longer); };
  const RasterGrid few = filling_grid(grid.bounds(), fewer(grid.columns()), fewer(grid.rows()));
  return {few, profile::averaged_cells(cells.colours, profile::counts_of(grid), profile::counts_of(few))};
}

std::string embedded(const RasterGrid& grid, const std::vector<std::uint8_t>& samples, int channels,
                     const std::string& type) {
  const viewshed::PictureSamples picture{samples, static_cast<int>(grid.columns()), static_cast<int>(grid.rows()),
                                         channels};
  return fmt::format("data:image/{};base64,{}", type,
                     base64(viewshed::picture_bytes(picture, "map." + type, kJpegQuality)));
}

/// Makes an opaque picture, in grey where the ground is relief.
std::string opaque_picture(const profile::SheetCells& cells) {
  std::vector<std::uint8_t> grey, colours;
  bool coloured = false;
  for (const Rgba& cell : cells.colours) {
    const Rgba c = cell.alpha > 0 ? cell : kNoGround;
    coloured = coloured || (cell.alpha > 0 && (c.red != c.green || c.green != c.blue));
    grey.push_back(c.green);
    for (const std::uint8_t v : {c.red, c.green, c.blue}) colours.push_back(v);
  }
  return coloured ? embedded(cells.grid, colours, 3, "jpeg") : embedded(cells.grid, grey, 1, "jpeg");
}

std::string clear_picture(const profile::SheetCells& cells) {
  std::vector<std::uint8_t> samples;
  for (const Rgba& c : cells.colours)
    for (const std::uint8_t v : {c.red, c.green, c.blue, c.alpha}) samples.push_back(v);
  return embedded(cells.grid, samples, 4, "png");
}

std::string web_colour(const Rgba& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

class WebLayer {
 public:
  WebLayer(const Box& frame, WebPicture picture) : frame_(frame), picture_(picture) {}

  std::string operator()(const profile::SheetCells& all) const {
    const profile::SheetCells cells = few_enough(all);
    const Box box = cells.grid.bounds();
    const bool ground = picture_ == WebPicture::kGround;
    return fmt::format(
        "<image{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" href=\"{}\"/>\n",
        ground ? "" : " class=\"map-cells\"", web_percent(across(box.xmin)), web_percent(down(box.ymax)),
        web_percent(across(box.xmax) - across(box.xmin)), web_percent(down(box.ymin) - down(box.ymax)),
        ground ? opaque_picture(cells) : clear_picture(cells));
  }

  std::string operator()(const profile::SheetAreas& areas) const {
    std::string path;
    for (const auto& rings : areas.areas)
      for (const std::vector<Point2>& ring : rings) path += path_of(ring) + "z";
    return drawn(fmt::format("fill=\"{}\" fill-opacity=\"{:.2g}\" fill-rule=\"evenodd\"", web_colour(areas.colour),
                             areas.colour.alpha / 255.0),
                 path);
  }

  std::string operator()(const profile::SheetLines& lines) const {
    std::string path;
    for (const profile::SheetLine& line : lines.lines) path += path_of(line.points);
    const double width = lines.width_mm * kPixelsPerMillimetre;
    return drawn(fmt::format("fill=\"none\" stroke=\"{}\" stroke-opacity=\"{:.2g}\" stroke-width=\"{:.2g}\"{} "
                             "vector-effect=\"non-scaling-stroke\"",
                             web_colour(lines.colour), lines.colour.alpha / 255.0, width,
                             lines.dashed ? " stroke-dasharray=\"8 5\"" : ""),
                 path);
  }

  std::string operator()(const profile::SheetMarks& marks) const {
    const std::string symbol = profile::symbol_svg(marks.symbol, marks.colour, kMarkPixels);
    std::string svg;
    for (const profile::SheetMark& mark : marks.marks)
      svg += fmt::format("<svg x=\"{}\" y=\"{}\" overflow=\"visible\">{}</svg>\n", web_percent(across(mark.at.x)),
                         web_percent(down(mark.at.y)), symbol);
    return svg;
  }

 private:
  double path_height() const { return std::round(kPathUnits * frame_.height() / frame_.width()); }

  std::string path_of(const std::vector<Point2>& ground) const {
    const double height = path_height();
    std::vector<Point2> points;
    for (const Point2& p : ground) points.push_back({across(p.x) * kPathUnits, down(p.y) * height});
    return svg_path(points, kTenthOfAPixel);
  }

  /// Returns a layer of one path.
  std::string drawn(const std::string& looks, const std::string& path) const {
    return fmt::format(
        "<svg width=\"100%\" height=\"100%\" viewBox=\"0 0 {} {}\" preserveAspectRatio=\"none\"><path {} "
        "d=\"{}\"/></svg>\n",
        kPathUnits, path_height(), looks, path);
  }

  double across(double x) const { return (x - frame_.xmin) / frame_.width(); }
  double down(double y) const { return (frame_.ymax - y) / frame_.height(); }

  Box frame_;
  WebPicture picture_;
};

}  // namespace

std::string web_layer(const Box& frame, const profile::SheetLayer& layer, WebPicture picture) {
  return std::visit(WebLayer(frame, picture), layer);
}

std::string web_percent(double share) {
  return fmt::format("{:.2f}%", 100 * share);
}

}  // namespace itin::cli
