#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/parallel.hpp>
#include <itin/void_stripes.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/relief.hpp>
#include <viewshed/result_sheet.hpp>
#include <viewshed/surface.hpp>

#include "bounds/pixel_heights.hpp"
#include "drawing/hillshade.hpp"

namespace itin::viewshed {

namespace {

constexpr Rgba kMapPaper{255, 255, 255, 255}, kBeyondRead{244, 244, 244, 255};
constexpr double kOutsideFade = 0.6;  ///< how far ground outside the field of view fades into the paper

std::string length_text(double metres) {
  return metres >= 1000 ? fmt::format("{:.10g} km", metres / 1000) : fmt::format("{:.10g} m", metres);
}

void require_possible(const MapOptions& options) {
  if (options.map_pixels < 200 || options.map_pixels > 16000)
    throw InputError(fmt::format("map of {} pixels: give 200 to 16000", options.map_pixels), "map_pixels");
}

RasterGrid pixel_grid(const RasterGrid& cells, int longest) {
  const Box box = cells.bounds();
  const double pixel = std::max(box.width(), box.height()) / longest;
  const auto count = [&](double length) { return std::max<std::int64_t>(1, std::llround(length / pixel)); };
  const std::int64_t columns = count(box.width()), rows = count(box.height());
  return {{box.xmin, box.ymax},
          box.width() / static_cast<double>(columns),
          box.height() / static_cast<double>(rows),
          columns,
          rows};
}

/// Colours that are laid over each other.
struct Blend {
  double red = 0, green = 0, blue = 0;

  void lay(const Rgba& c, double opacity) {
    red += opacity * (c.red - red), green += opacity * (c.green - green), blue += opacity * (c.blue - blue);
  }
  Rgba colour() const {
    const auto channel = [](double v) { return static_cast<std::uint8_t>(std::lround(v)); };
    return {channel(red), channel(green), channel(blue), 255};
  }
};

/// The mean of what a pixel's samples show.
struct Shown {
  double red = 0, green = 0, blue = 0;  ///< times the opacity
  double opacity = 0;
  double outside = 0;  ///< share outside the field of view

  void add(const Rgba& c, double share) {
    const double of = share * c.alpha / 255;
    opacity += of, red += of * c.red, green += of * c.green, blue += of * c.blue;
  }
  Rgba colour() const {
    const auto channel = [&](double sum) { return static_cast<std::uint8_t>(std::lround(sum / opacity)); };
    return opacity > 0 ? Rgba{channel(red), channel(green), channel(blue), 255} : Rgba{};
  }
};

/// The colours of a result over shaded ground, pixel by pixel.
class PixelColours {
 public:
  PixelColours(const Result& result, const MapOptions& options, const std::vector<Rgba>& cells, const RasterGrid& grid)
      : result_(result),
        options_(options),
        cells_(cells),
        grid_(grid),
        apart_(profile::void_stripe_pixels(options.map_pixels)) {}

  /// `heights` are those of the ground.
  std::vector<Rgba> over(const std::vector<float>& heights) const {
    const std::vector<float> shades = hillshade(heights, grid_);
    std::vector<Rgba> colours(shades.size());
    parallel_for(static_cast<std::size_t>(grid_.rows()), [&](std::size_t row) {
      for (std::int64_t column = 0; column < grid_.columns(); ++column) {
        const RasterGrid::Cell pixel{column, static_cast<std::int64_t>(row)};
        colours[grid_.index(pixel)] = colour(pixel, shades[grid_.index(pixel)]);
      }
    });
    return colours;
  }

 private:
  Rgba colour(const RasterGrid::Cell& pixel, float shade) const {
    const auto cell = result_.grid.cell_at(grid_.centre(pixel.column, pixel.row));
    if (cell && lacks_ground(result_.grid.index(*cell))) return opaque(void_colour(pixel.column, pixel.row, apart_));
    if (std::isnan(shade)) return kBeyondRead;
    const Shown shown = shown_at(pixel);
    const double grey = std::clamp(214 + 150.0 * (shade - kLevelShade), 100.0, 250.0);
    Blend blend{grey, grey, grey};
    blend.lay(kMapPaper, kOutsideFade * shown.outside);
    blend.lay(shown.colour(), shown.opacity);
    return blend.colour();
  }

  static Rgba opaque(Rgba c) {
    c.alpha = 255;
    return c;
  }
  bool lacks_ground(std::size_t cell) const { return cell < options_.no_data.size() && options_.no_data[cell] == 1; }

  Shown shown_at(const RasterGrid::Cell& pixel) const {
    // There are as many samples as cells along a pixel's side, within reason, so that thin shadows are not lost.
    const double cells = grid_.cell_width() / result_.grid.cell_width();
    const int samples = static_cast<int>(std::clamp(std::ceil(cells), 1.0, 4.0));
    const double share = 1.0 / (samples * samples);
    const Point2 centre = grid_.centre(pixel.column, pixel.row);
    Shown shown;
    for (int i = 0; i < samples; ++i) {
      for (int j = 0; j < samples; ++j) {
        const auto cell = result_.grid.cell_at({centre.x + ((i + 0.5) / samples - 0.5) * grid_.cell_width(),
                                                centre.y + ((j + 0.5) / samples - 0.5) * grid_.cell_height()});
        const bool in_view = cell && result_.visible[result_.grid.index(*cell)] != Verdict::kOutside;
        in_view ? shown.add(cells_[result_.grid.index(*cell)], share) : void(shown.outside += share);
      }
    }
    return shown;
  }

  const Result& result_;
  const MapOptions& options_;
  const std::vector<Rgba>& cells_;
  const RasterGrid& grid_;
  int apart_;  ///< stripes where there is no ground
};

std::string subtitle_of(const Result& result) {
  const Request& r = result.request;
  const Observer& first = r.observers.front();
  const bool alike = std::all_of(r.observers.begin(), r.observers.end(), [&](const Observer& o) {
    return o.height == first.height && o.absolute == first.absolute;
  });
  std::string text = r.observers.size() == 1 ? "Observer" : fmt::format("{} observers", r.observers.size());
  const auto height = [](double metres, bool absolute) {
    return fmt::format("{} {:g} m {}", absolute ? " at" : "", metres, absolute ? "elevation" : "above ground");
  };
  if (alike) text += height(first.height, first.absolute);
  if (r.mode != Mode::kHeight) text += ", target" + height(r.target_height, r.target_absolute);
  if (r.radius) text += ", within " + length_text(*r.radius);
  text += fmt::format("; cells of {}", length_text(result.grid.cell_width()));
  return text;
}

MapObjects observers_of(const Result& result, const MapOptions& options) {
  std::vector<profile::SheetMark> marks;
  for (const Observer& observer : result.request.observers) marks.push_back({observer.position, observer.name});
  const char* const several = marks.size() == 1 ? "Observer" : "Observers";
  return mast_objects(std::move(marks), options.observers.empty() ? several : options.observers);
}

profile::TitleBlock title_of(const Result& result, const MapOptions& options) {
  profile::TitleBlock title;
  title.title = options.title;
  title.statement = options.subtitle.empty() ? subtitle_of(result) : options.subtitle;
  title.facts.emplace_back("Earth", result.request.earth.convention());
  if (!options.beyond_text.empty()) title.facts.emplace_back("Beyond the ground data", options.beyond_text);
  title.sources = options.sources;
  return title;
}

ResultSheet content_of(const Result& result, const MapOptions& options) {
  ResultSheet content;
  content.grid = result.grid, content.area = result.grid.bounds();
  content.map = result_map(result, options);
  content.studied = in_cells(result.grid, [&](std::size_t cell) { return result.visible[cell] != Verdict::kOutside; });
  for (const MapDots& dots : options.dots) content.objects.push_back(dot_objects(dots));
  content.objects.push_back(observers_of(result, options));
  content.title = title_of(result, options);
  content.outside = options.outside;
  if (std::find(options.no_data.begin(), options.no_data.end(), 1) != options.no_data.end())
    content.missing = {in_cells(result.grid, [&](std::size_t cell) { return options.no_data[cell] == 1; }),
                       options.no_data_text};
  return content;
}

/// heights_of(pixels) returns the heights of the ground.
template <class HeightsOf>
MapImage drawn_map(const HeightsOf& heights_of, const Result& result, const MapOptions& options) {
  require_possible(options);
  const ResultSheet content = content_of(result, options);
  const RasterGrid pixels = pixel_grid(result.grid, options.map_pixels);
  const MapBase base{
      {pixels, PixelColours(result, options, content.map.cells, pixels).over(heights_of(pixels))}, {}, {}, {}};
  profile::MapSheet sheet;
  sheet.area = content.area, sheet.crs_wkt = options.crs_wkt;
  sheet.layers = {base.picture};
  for (const MapObjects& objects : content.objects)
    sheet.layers.insert(sheet.layers.end(), objects.layers.begin(), objects.layers.end());
  sheet.legend = keys_of(base, content, content.area);
  sheet.title = content.title;
  const profile::MapPicture picture = profile::draw_map_picture(sheet, options.map_pixels);
  return {picture.width, picture.height, {picture.rgb.begin(), picture.rgb.end()}};
}

}  // namespace

MapImage draw_map(const Tin& tin, const Result& result, const MapOptions& options) {
  return drawn_map([&](const RasterGrid& pixels) { return heights_at(tin, pixels); }, result, options);
}

MapImage draw_map(RetrievedSurface& surface, const Result& result, Progress& progress, const MapOptions& options) {
  if (!surface.lattice) return draw_map(surface.tin, result, options);
  surface.lattice->read_all(progress);
  const LatticeTin& lattice = surface.lattice->lattice();
  return drawn_map([&](const RasterGrid& pixels) { return heights_at(lattice, pixels); }, result, options);
}

}  // namespace itin::viewshed
