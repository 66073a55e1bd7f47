#include "sheet/map_symbols.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <itin/void_stripes.hpp>

#include "drawing/palette.hpp"
#include "sheet/paper.hpp"

namespace itin::profile {

namespace {

/// The size of a dot, of that of other symbols.
constexpr double kDotSize = 0.55;

/// The corners of a symbol about its place, for a height of 1. Empty for discs and for turbines.
std::span<const Point2> corners_of(SheetSymbol symbol) {
  static constexpr std::array<Point2, 4> kSquare{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
  static constexpr std::array<Point2, 4> kDiamond{{{0, -0.62}, {0.62, 0}, {0, 0.62}, {-0.62, 0}}};
  static constexpr std::array<Point2, 3> kTriangle{{{0, -0.6}, {0.6, 0.45}, {-0.6, 0.45}}};
  if (symbol == SheetSymbol::kHub) return kSquare;
  if (symbol == SheetSymbol::kRelay) return kDiamond;
  if (symbol == SheetSymbol::kExistingMast) return kTriangle;
  return {};
}

void draw_turbine(Drawing& drawing, Point2 at, double size, const Colour& fill) {
  const Point2 hub{at.x, at.y - 0.45 * size};
  const auto blades = [&](const Stroke& stroke) {
    drawing.polyline(std::array{at, hub}, stroke);
    for (const double sixths : {0.0, 2.0, 4.0}) {
      const double angle = sixths * std::numbers::pi / 3, r = 0.5 * size;
      drawing.polyline(std::array{hub, Point2{hub.x + r * std::sin(angle), hub.y - r * std::cos(angle)}}, stroke);
    }
  };
  blades({{1, 1, 1, 0.9}, 0.34 * size, {}});
  blades({fill, 0.15 * size, {}});
}

/// Draws the colours side by side, over the grey of level ground in the relief.
void draw_patch(Drawing& drawing, const std::vector<Rgba>& colours, const Box& box) {
  constexpr double kLevelGround = 0.84;
  drawing.rectangle(box, {kLevelGround, kLevelGround, kLevelGround});
  const double part = box.width() / static_cast<double>(colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double from = box.xmin + part * static_cast<double>(i);
    drawing.rectangle({from, box.ymin, from + part, box.ymax}, drawn(colours[i]));
  }
}

/// Stripes a patch as void_colour() stripes the map's pixels.
void draw_void(Drawing& drawing, const Box& box) {
  constexpr double kPixel = kSheetPixelMm * kPointsPerMillimetre, kApart = kVoidStripePixels * kPixel,
                   kWide = void_stripe_width(kVoidStripePixels) * kPixel;
  drawing.rectangle(box, drawn(kVoid));
  // The ends of the line x + y = sum within the box.
  const auto upper = [&](double sum) {
    const double x = std::min(sum - box.ymin, box.xmax);
    return Point2{x, sum - x};
  };
  const auto lower = [&](double sum) {
    const double y = std::min(sum - box.xmin, box.ymax);
    return Point2{sum - y, y};
  };
  const double last = box.xmax + box.ymax;
  for (double from = box.xmin + box.ymin; from < last; from += kApart) {
    const double to = std::min(from + kWide, last);
    drawing.polygon(std::array{upper(from), upper(to), lower(to), lower(from)}, drawn(kVoidStripe));
  }
}

}  // namespace

void draw_symbol(Drawing& drawing, SheetSymbol symbol, Point2 at, double size, const Rgba& colour) {
  const Colour fill = drawn(colour);
  if (symbol == SheetSymbol::kTurbine) return draw_turbine(drawing, at, size, fill);
  if (const std::span<const Point2> corners = corners_of(symbol); !corners.empty()) {
    std::vector<Point2> outer, inner;
    for (const Point2& c : corners) {
      outer.push_back({at.x + size * c.x, at.y + size * c.y});
      inner.push_back({at.x + 0.82 * size * c.x, at.y + 0.82 * size * c.y});
    }
    drawing.polygon(outer, kPaper);
    drawing.polygon(inner, fill);
    return;
  }
  const double across = symbol == SheetSymbol::kDot ? kDotSize * size : size;
  drawing.circle(at, 0.5 * across, kPaper);
  drawing.circle(at, 0.43 * across, fill);
  if (symbol == SheetSymbol::kViewpoint) drawing.circle(at, 0.18 * size, kPaper);
}

std::vector<double> map_dashes(double type) {
  return {2.2 * kPointsPerMillimetre * type, 1.4 * kPointsPerMillimetre * type};
}

void draw_sample(Drawing& drawing, const SheetKey& key, const Box& box, double type) {
  using enum SheetKey::Sample;
  const Point2 middle{(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
  if (key.sample == kMark) {
    const double size = 1.18 * box.height(), up = key.symbol == SheetSymbol::kTurbine ? 0.4 * size : 0;
    return draw_symbol(drawing, key.symbol, {middle.x, middle.y + up}, size, key.colours.front());
  }
  if (key.sample == kLine || key.sample == kDashes) {
    const Stroke stroke{drawn(key.colours.front()), 0.35 * kPointsPerMillimetre * type,
                        key.sample == kDashes ? map_dashes(type) : std::vector<double>{}};
    return drawing.polyline(std::array{Point2{box.xmin, middle.y}, Point2{box.xmax, middle.y}}, stroke);
  }
  key.sample == SheetKey::Sample::kVoid ? draw_void(drawing, box) : draw_patch(drawing, key.colours, box);
  drawing.outline(box, {kFaint, 0.3 * type, {}});
}

std::string symbol_svg(SheetSymbol symbol, const Rgba& colour, double size) {
  Drawing drawing(Drawing::Format::kSvgParts, size, size);
  draw_symbol(drawing, symbol, {0, 0}, size, colour);
  return drawing.finish();
}

std::string sample_svg(const SheetKey& key, double width, double height) {
  constexpr double kWebType = 1.6;
  Drawing drawing(Drawing::Format::kSvgParts, width, height);
  draw_sample(drawing, key, {0.5, 0.1 * height, width - 0.5, 0.9 * height}, kWebType);
  return drawing.finish();
}

}  // namespace itin::profile
