#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/coordinates.hpp>
#include <itin/in_ring.hpp>
#include <itin/parallel.hpp>
#include <itin/surface_text.hpp>
#include <itin/void_stripes.hpp>
#include <viewshed/result_sheet.hpp>

namespace itin::viewshed {

namespace {

using profile::SheetKey;

constexpr Rgba kNoGroundColour{237, 237, 242, 255}, kFadedColour{255, 255, 255, 153};

/// A sheet that has no layers, legend and title yet.
profile::MapSheet empty_sheet(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                              const profile::SheetChoice& choice) {
  profile::MapSheet sheet;
  sheet.paper = paper, sheet.scale = choice.scale, sheet.area = content.area;
  sheet.crs_wkt = store.metadata().crs_wkt;
  return sheet;
}

struct Beyond {
  std::size_t all = 0;
  std::vector<std::string> names;  ///< names of objects that lie wholly beyond the frame

  void add(const Box& extent, const std::string& name, const Box& frame) {
    ++all;
    if (!extent.meets(frame)) names.push_back(name);
  }
};

bool stands_for(const SheetKey& key, const profile::SheetMarks& marks) {
  return key.sample == SheetKey::Sample::kMark && key.symbol == marks.symbol && key.colours.front() == marks.colour;
}
bool stands_for(const SheetKey& key, const profile::SheetLines& lines) {
  const auto sample = lines.dashed ? SheetKey::Sample::kDashes : SheetKey::Sample::kLine;
  return key.sample == sample && key.colours.front() == lines.colour;
}
bool stands_for(const SheetKey& key, const profile::SheetAreas& areas) {
  return key.sample == SheetKey::Sample::kPatch && key.colours.front() == areas.colour;
}
bool stands_for(const SheetKey&, const profile::SheetCells&) {
  return false;
}

void add_objects(const profile::SheetMarks& marks, const Box& frame, Beyond& beyond) {
  for (const profile::SheetMark& mark : marks.marks)
    beyond.add({mark.at.x, mark.at.y, mark.at.x, mark.at.y}, mark.label, frame);
}
void add_objects(const profile::SheetLines& lines, const Box& frame, Beyond& beyond) {
  for (const profile::SheetLine& line : lines.lines) {
    Box extent;
    for (const Point2& p : line.points) extent.extend(p);
    beyond.add(extent, line.label, frame);
  }
}
void add_objects(const profile::SheetAreas& areas, const Box& frame, Beyond& beyond) {
  for (const std::vector<std::vector<Point2>>& rings : areas.areas) beyond.add(box_of_rings(rings), "", frame);
}
void add_objects(const profile::SheetCells&, const Box&, Beyond&) {}

/// The text that a legend adds to a key: "; 2 of 5 beyond the map: 3 Inn, 5 Church".
std::string beyond_the_map(const MapObjects& objects, const SheetKey& key, const Box& frame) {
  constexpr std::size_t kMostNames = 12;
  Beyond beyond;
  for (const profile::SheetLayer& layer : objects.layers)
    std::visit(
        [&](const auto& l) {
          if (stands_for(key, l)) add_objects(l, frame, beyond);
        },
        layer);
  std::vector<std::string>& names = beyond.names;
  if (names.empty()) return "";
  const std::string count = fmt::format("; {} of {} beyond the map", names.size(), beyond.all);
  std::erase(names, "");
  if (names.empty()) return count;
  if (const std::size_t all = names.size(); all > kMostNames) {
    names.resize(kMostNames - 1);
    names.push_back(fmt::format("{} more", all - names.size()));
  }
  return fmt::format("{}: {}", count, fmt::join(names, ", "));
}

Rgba paler(const Rgba& c) {
  constexpr double kFade = 0.6;
  const auto part = [](std::uint8_t v) { return static_cast<std::uint8_t>(std::lround(v + kFade * (255 - v))); };
  return {part(c.red), part(c.green), part(c.blue), c.alpha};
}

/// Calls visit(pixel, centre, colour) for each pixel, on any thread.
template <class Visit>
void for_each_pixel(profile::SheetCells& picture, const Visit& visit) {
  const RasterGrid& grid = picture.grid;
  parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t r) {
    RasterGrid::Cell pixel{0, static_cast<std::int64_t>(r)};
    for (; pixel.column < grid.columns(); ++pixel.column)
      visit(pixel, grid.centre(pixel.column, pixel.row), picture.colours[grid.index(pixel)]);
  });
}

bool has_clear_pixels(const profile::SheetCells& picture) {
  return std::any_of(picture.colours.begin(), picture.colours.end(), [](const Rgba& c) { return c.alpha == 0; });
}

bool shows_outside(const profile::SheetCells& picture, const ResultSheet& content) {
  const auto is_outside = [&](Point2 p) {
    return !content.studied(p) && !(content.missing.there && content.missing.there(p));
  };
  for (std::int64_t row = 0; row < picture.grid.rows(); ++row)
    for (std::int64_t column = 0; column < picture.grid.columns(); ++column)
      if (picture.colours[picture.grid.index({column, row})].alpha > 0 && is_outside(picture.grid.centre(column, row)))
        return true;
  return false;
}

}  // namespace

std::vector<std::string> sheet_names(const std::string& map, profile::PaperSize paper) {
  const std::string name = fmt::format("sheet-{}-{}", map, profile::name_of(paper));
  return {name + ".pdf", name + ".png"};
}

MissingOnSheet missing_on_sheet(PlacesWithoutGround places, const MissingGround& missing, const std::string& area) {
  if (missing.share() == 0) return {};
  return {[places = std::move(places)](Point2 p) { return places.contain(p); }, missing.key_text(area)};
}

std::function<bool(Point2)> in_cells(const RasterGrid& grid, std::function<bool(std::size_t)> studied) {
  return [grid, studied = std::move(studied)](Point2 p) {
    const auto cell = grid.cell_at(p);
    return cell && studied(grid.index(*cell));
  };
}

ResultSheet object_sheet(const Box& shown, std::vector<MapObjects> objects, profile::TitleBlock title) {
  const double side = std::max({shown.width(), shown.height(), 1.0});
  ResultSheet sheet{RasterGrid({shown.xmin, shown.ymax}, side, side, 1, 1), shown, {}, "", {}, {}, {}};
  sheet.map.cells = {kTransparent};
  sheet.studied = [](Point2) { return true; };
  sheet.objects = std::move(objects), sheet.title = std::move(title);
  return sheet;
}

std::string statement_of(const StoreMetadata& metadata, const ThemeChoice& themes, const Detail& detail) {
  if (!themes.includes_raised(metadata.themes))
    return "Bare ground: the screening effect of buildings, walls and vegetation is not taken into account.";
  const std::string as =
      detail.coarsest() == 0
          ? "as imported"
          : fmt::format("as far as they stand at a tolerance of {:g} m, at which lower ones may be left out,",
                        detail.coarsest());
  const std::string omitted = omitted_text(themes);
  return fmt::format("Screening by {} {}{} is taken into account; whatever else stands on the ground is not.",
                     listed(themes.names(metadata.themes)), as, omitted.empty() ? "" : ", " + omitted + ",");
}

std::pair<std::string, std::string> terrain_fact(const StoreMetadata& metadata, const Detail& detail) {
  double spacing = 0;
  for (const SourceInfo& source : metadata.sources)
    if (source.kind == "terrain") spacing = std::max(spacing, source.spacing);
  const std::string posts = spacing > 0 ? fmt::format("posts up to {} m apart; ", significant(spacing, 3)) : "";
  return {"Terrain", posts + surface_text(metadata, detail)};
}

MapBase fitted(MapBase base, const ResultSheet& content, int stripes) {
  for_each_pixel(base.picture, [&](RasterGrid::Cell pixel, Point2 centre, Rgba& colour) {
    if (content.missing.there && content.missing.there(centre)) {
      colour = void_colour(pixel.column, pixel.row, stripes);
    } else if (colour.alpha > 0 && !content.studied(centre)) {
      colour = paler(colour);
    }
  });
  return base;
}

MapBase base_of(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                const profile::SheetChoice& choice, Progress& progress) {
  const profile::MapSheet sheet = empty_sheet(store, content, paper, choice);
  return fitted(map_base(store, profile::ground_in_frame(sheet), profile::scale_of(sheet), choice.basemap, progress),
                content);
}

std::vector<profile::SheetLayer> layers_of(const MapBase& base, ResultSheet content) {
  std::vector<profile::SheetLayer> layers = layers_of(base, {content.grid, std::move(content.map.cells)});
  for (const MapObjects& objects : content.objects)
    layers.insert(layers.end(), objects.layers.begin(), objects.layers.end());
  return layers;
}

std::vector<SheetKey> keys_of(const MapBase& base, const ResultSheet& content, const Box& frame) {
  std::vector<SheetKey> keys;
  const auto add = [&](const std::string& heading, const std::vector<ResultMap::Key>& more) {
    if (more.empty()) return;
    if (!heading.empty()) keys.push_back({SheetKey::Sample::kHeading, {}, heading});
    for (const auto& key : more) keys.push_back({SheetKey::Sample::kPatch, key.colours, key.text});
  };
  add(content.heading, content.map.keys);
  if (!content.missing.text.empty()) keys.push_back({SheetKey::Sample::kVoid, {}, content.missing.text});
  if (!content.outside.empty() && shows_outside(base.picture, content))
    keys.push_back({SheetKey::Sample::kPatch, {kFadedColour}, content.outside});
  add(content.map.scale_title, content.map.scale);
  keys.push_back({SheetKey::Sample::kHeading, {}, "Map"});
  for (const MapObjects& objects : content.objects)
    for (SheetKey key : objects.keys) {
      key.text += beyond_the_map(objects, key, frame);
      keys.push_back(std::move(key));
    }
  keys.insert(keys.end(), base.keys.begin(), base.keys.end());
  if (!base.clear.empty() && has_clear_pixels(base.picture))
    keys.push_back({SheetKey::Sample::kPatch, {kNoGroundColour}, base.clear});
  return keys;
}

profile::MapSheet map_sheet(const Store& store, const ResultSheet& content, const MapBase& base,
                            profile::PaperSize paper, const profile::SheetChoice& choice) {
  profile::MapSheet sheet = empty_sheet(store, content, paper, choice);
  sheet.layers = layers_of(base, content);
  sheet.legend = keys_of(base, content, profile::ground_in_frame(sheet));
  sheet.title = content.title;
  sheet.title.facts.emplace_back("Coordinates", crs_title(store.metadata().crs_wkt));
  if (!choice.basemap.empty()) sheet.title.facts.push_back(basemap_fact(choice.basemap));
  sheet.title.project = choice.project, sheet.title.date = choice.date;
  return sheet;
}

std::string draw_result_sheet(const Store& store, const ResultSheet& content, profile::PaperSize paper,
                              const profile::SheetChoice& choice, const std::string& name, Progress& progress) {
  const MapBase base = base_of(store, content, paper, choice, progress);
  return profile::draw_map_sheet(map_sheet(store, content, base, paper, choice), name);
}

}  // namespace itin::viewshed
