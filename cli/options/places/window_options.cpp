#include "options/places/window_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/window_source.hpp>

#include "options/places/off_the_data.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

constexpr std::string_view kBoxShape = "xmin,ymin,xmax,ymax";
constexpr std::string_view kDiscShape = "x,y,r";
constexpr std::string_view kWedgeShape = "x,y,azimuth,width,r";
constexpr std::string_view kCorridorShape = "x0,y0,x1,y1,width";

void require_positive(std::string_view option, std::string_view what, double value) {
  if (value <= 0) throw InputError(fmt::format("{}: the {} must be greater than 0", option, what));
}

/// A box in another CRS has curved sides; each is cut into this many chords.
constexpr int kSideParts = 32;

Window transformed_box(const std::vector<double>& v, const std::function<Point2(Point2)>& transform) {
  const Point2 corners[] = {{v[0], v[1]}, {v[2], v[1]}, {v[2], v[3]}, {v[0], v[3]}, {v[0], v[1]}};
  Window::Polygon polygon;
  for (int side = 0; side < 4; ++side) {
    for (int part = 0; part < kSideParts; ++part) {
      const double t = static_cast<double>(part) / kSideParts;
      const Point2 a = corners[side], b = corners[side + 1];
      polygon.outer.push_back(transform({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}));
    }
  }
  return Window::polygons({std::move(polygon)});
}

Point2 middle(const Box& box) {
  return {(box.xmin + box.xmax) / 2, (box.ymin + box.ymax) / 2};
}

}  // namespace

void WindowOptions::declare(CLI::App& app) {
  begin_group(app, "Window, one of");
  const auto shape = [&](const char* name, std::string& value, const char* what, std::string_view form) {
    return app.add_option(name, value, what)->type_name(std::string(form));
  };
  shape("--bbox", bbox_, "A box", kBoxShape);
  reads(shape("--polygon", polygon_, "A polygon as WKT, or a vector file of polygons", "WKT|FILE"));
  shape("--disc", disc_, "A disc", kDiscShape);
  shape("--wedge", wedge_, "A sector; azimuth of its axis and width in degrees", kWedgeShape);
  shape("--corridor", corridor_, "A strip along a line", kCorridorShape);
  app.add_flag("--all", all_, "Everything the store covers");
  in_crs_.declare(app);
}

void WindowOptions::validate() {
  const int given = static_cast<int>(!bbox_.empty()) + static_cast<int>(!polygon_.empty()) +
                    static_cast<int>(!disc_.empty()) + static_cast<int>(!wedge_.empty()) +
                    static_cast<int>(!corridor_.empty()) + static_cast<int>(all_);
  if (given != 1) {
    throw InputError("give one window: --bbox, --polygon, --disc, --wedge, --corridor or --all");
  }
  if (!bbox_.empty()) {
    shape_ = Shape::kBox;
    const Box box = parse_box("--bbox", bbox_);
    numbers_ = {box.xmin, box.ymin, box.xmax, box.ymax};
  } else if (!polygon_.empty()) {
    shape_ = Shape::kPolygon;
  } else if (!disc_.empty()) {
    shape_ = Shape::kDisc;
    numbers_ = parse_tuple("--disc", disc_, 3, kDiscShape);
    require_positive("--disc", "radius", numbers_[2]);
  } else if (!wedge_.empty()) {
    shape_ = Shape::kWedge;
    numbers_ = parse_tuple("--wedge", wedge_, 5, kWedgeShape);
    if (numbers_[3] <= 0 || numbers_[3] > 360) throw InputError("--wedge: the width must be in (0, 360] degrees");
    require_positive("--wedge", "radius", numbers_[4]);
  } else if (!corridor_.empty()) {
    shape_ = Shape::kCorridor;
    numbers_ = parse_tuple("--corridor", corridor_, 5, kCorridorShape);
    require_positive("--corridor", "width", numbers_[4]);
    if (numbers_[0] == numbers_[2] && numbers_[1] == numbers_[3]) {
      throw InputError("--corridor: its two ends are the same point");
    }
  }
}

WindowOptions::Region WindowOptions::region(const StoreMetadata& metadata) const {
  const auto transform = in_crs_.transform_to(metadata.crs_wkt);
  const std::vector<double>& v = numbers_;
  switch (shape_) {
    case Shape::kDisc: {
      const Point2 centre = transform({v[0], v[1]});
      return {Window::disc(centre, v[2]), centre};
    }
    case Shape::kWedge: {
      const Point2 apex = transform({v[0], v[1]});
      return {Window::wedge(apex, v[2], v[3], v[4]), apex};
    }
    case Shape::kCorridor: {
      const Window window = Window::corridor(transform({v[0], v[1]}), transform({v[2], v[3]}), v[4]);
      return {window, middle(window.bounds())};
    }
    case Shape::kBox: {
      const Window window = in_crs_.crs.empty() ? Window::box({v[0], v[1], v[2], v[3]}) : transformed_box(v, transform);
      return {window, middle(window.bounds())};
    }
    case Shape::kPolygon: {
      const Window window = window_from_polygon(polygon_, metadata.crs_wkt, in_crs_.crs);
      return {window, middle(window.bounds())};
    }
    case Shape::kAll:
      break;
  }
  return {Window::all(), middle(metadata.grid.box(metadata.bounds))};
}

std::string WindowOptions::no_ground(const StoreMetadata& metadata) const {
  const std::vector<double>& v = numbers_;
  std::optional<std::string> off;
  if (shape_ == Shape::kBox) {
    const Point2 centre = middle({v[0], v[1], v[2], v[3]});
    if ((off = off_the_data(centre, in_crs_, metadata)))
      off = fmt::format("its middle, {:.10g},{:.10g}, {}", centre.x, centre.y, *off);
  } else if (!v.empty()) {
    if ((off = off_the_data({v[0], v[1]}, in_crs_, metadata)))
      off = fmt::format("its point {:.10g},{:.10g} {}", v[0], v[1], *off);
  }
  return fmt::format("the window holds no ground; {}", off.value_or("the data is " + extent_of(metadata)));
}

Document WindowOptions::parameters() const {
  Document parameters;
  switch (shape_) {
    case Shape::kBox:
      parameters["bbox"] = numbers_;
      break;
    case Shape::kPolygon:
      parameters["polygon"] = polygon_;
      break;
    case Shape::kDisc:
      parameters["disc"] = numbers_;
      break;
    case Shape::kWedge:
      parameters["wedge"] = numbers_;
      break;
    case Shape::kCorridor:
      parameters["corridor"] = numbers_;
      break;
    case Shape::kAll:
      parameters["all"] = true;
      break;
  }
  if (!in_crs_.crs.empty()) parameters["in_crs"] = in_crs_.crs;
  return parameters;
}

}  // namespace itin::cli
