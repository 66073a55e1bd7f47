#include "ztv/ztv_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/contour_lines.hpp>
#include <itin/coordinates.hpp>
#include <itin/output_file.hpp>
#include <itin/parallel.hpp>
#include <itin/sources_in.hpp>
#include <viewshed/result_map.hpp>
#include <viewshed/zone_maps.hpp>

#include "output/map_base.hpp"
#include "output/store_document.hpp"
#include "ztv/ztv_methods.hpp"

namespace itin::cli {

namespace {

using profile::MapSheet;
using profile::SheetColour;
using profile::SheetKey;
using viewshed::Turbine;
using viewshed::Zone;
using viewshed::ZoneMap;

constexpr SheetColour kRing{70, 70, 70, 255}, kStudyArea{20, 20, 20, 255}, kViewpoint{20, 60, 140, 255};
constexpr std::size_t kMostFarmColours = 8;

/// Metres beyond its radius of the turbine that is farthest within it: not above 0 in the study area.
double beyond_study_area(const Zone& zone, Point2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Turbine& t : zone.request.turbines)
    least = std::min(least, std::hypot(t.position.x - p.x, t.position.y - p.y) - t.radius);
  return least;
}

double nearest_turbine(const Zone& zone, Point2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Turbine& t : zone.request.turbines)
    least = std::min(least, std::hypot(t.position.x - p.x, t.position.y - p.y));
  return least;
}

Box study_area(const Zone& zone) {
  Box box;
  for (const Turbine& t : zone.request.turbines) {
    box.extend(Point2{t.position.x - t.radius, t.position.y - t.radius});
    box.extend(Point2{t.position.x + t.radius, t.position.y + t.radius});
  }
  return box;
}

/// Values of a function of the position over a box, close enough for smooth lines.
struct PlaneField {
  RasterGrid grid;
  std::vector<float> values;

  template <class Value>
  PlaneField(const Box& box, const Value& value) {
    constexpr double kAcross = 800;
    const double step = std::max(box.width(), box.height()) / kAcross;
    grid = {{box.xmin - 2 * step, box.ymax + 2 * step},
            step,
            step,
            static_cast<std::int64_t>(box.width() / step) + 5,
            static_cast<std::int64_t>(box.height() / step) + 5};
    values.resize(grid.cell_count());
    parallel_for(static_cast<std::size_t>(grid.rows()), [&](std::size_t row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const RasterGrid::Cell cell{column, static_cast<std::int64_t>(row)};
        values[grid.index(cell)] = static_cast<float>(value(grid.centre(cell.column, cell.row)));
      }
    });
  }

  void add_lines(double level, const std::string& label, profile::SheetLines& lines) const {
    for (auto& points : contour_lines(grid, values, level)) lines.lines.push_back({std::move(points), label});
  }
};

/// Rings every 5 km of distance to the nearest turbine; in small study areas every 1 km, in large ones every 10.
double ring_step(double farthest) {
  return farthest <= 7500 ? 1000 : farthest <= 50000 ? 5000 : 10000;
}

/// What every map of the zone has above its classes.
class Furniture {
 public:
  Furniture(const Zone& zone, const ZtvSheetFacts& facts) {
    add_rings(zone);
    add_turbines(zone);
    if (facts.viewpoints.empty()) return;
    profile::SheetMarks marks{profile::SheetSymbol::kViewpoint, kViewpoint, {}};
    for (const NamedPlace& v : facts.viewpoints)
      marks.marks.push_back({v.position, fmt::format("{} {}", v.number, v.name)});
    layers.emplace_back(std::move(marks));
    keys.push_back({SheetKey::Sample::kMark, kViewpoint, "Viewpoint", profile::SheetSymbol::kViewpoint});
  }

  std::vector<profile::SheetLayer> layers;
  std::vector<SheetKey> keys;

 private:
  void add_rings(const Zone& zone) {
    const Box box = study_area(zone);
    double farthest = 0;
    for (const Turbine& t : zone.request.turbines) farthest = std::max(farthest, t.radius);
    const double step = ring_step(farthest);
    profile::SheetLines rings{{}, kRing, 0.15, false}, edge{{}, kStudyArea, 0.4, true};
    const PlaneField distance(box, [&](Point2 p) { return nearest_turbine(zone, p); });
    for (double at = step; at < farthest; at += step) distance.add_lines(at, fmt::format("{:g} km", at / 1000), rings);
    PlaneField(box, [&](Point2 p) { return beyond_study_area(zone, p); }).add_lines(0, "", edge);
    layers.emplace_back(std::move(rings));
    layers.emplace_back(std::move(edge));
    keys.push_back({SheetKey::Sample::kDashes, kStudyArea, "Study area"});
    keys.push_back(
        {SheetKey::Sample::kLine, kRing, fmt::format("Distance to the nearest turbine, every {:g} km", step / 1000)});
  }

  void add_turbines(const Zone& zone) {
    std::vector<std::string> farms = viewshed::farms_of(zone);
    if (farms.size() > kMostFarmColours) farms = {""};
    const bool single = farms.size() == 1;
    for (std::size_t f = 0; f < farms.size(); ++f) {
      profile::SheetMarks marks{profile::SheetSymbol::kTurbine, farm_colour(f), {}};
      for (const Turbine& t : zone.request.turbines)
        if (single || t.farm == farms[f]) marks.marks.push_back({t.position, fmt::format("{}", t.number)});
      const std::string turbines = counted(marks.marks.size(), "wind turbine") + ", numbered";
      keys.push_back({SheetKey::Sample::kMark, marks.colour,
                      farms[f].empty() ? turbines : fmt::format("{}: {}", farms[f], turbines), marks.symbol});
      layers.emplace_back(std::move(marks));
    }
  }

  static SheetColour farm_colour(std::size_t farm) {
    constexpr SheetColour kColours[kMostFarmColours] = {{170, 20, 20},  {20, 40, 110}, {0, 90, 60}, {110, 50, 0},
                                                        {100, 20, 100}, {0, 80, 110},  {70, 70, 0}, {60, 60, 60}};
    return kColours[farm];
  }
};

profile::SheetCells classes_of(const Zone& zone, const ZoneMap& map) {
  profile::SheetCells cells{zone.grid, std::vector<SheetColour>(map.class_of_cell.size(), SheetColour{0, 0, 0, 0})};
  for (std::size_t i = 0; i < cells.colours.size(); ++i) {
    if (map.class_of_cell[i] == viewshed::kNoMapClass) continue;
    const ZoneMap::Class& c = map.classes[map.class_of_cell[i]];
    if (c.alpha > 0) cells.colours[i] = {c.red, c.green, c.blue, viewshed::kAlphaOverRelief};
  }
  return cells;
}

/// Three figures, or whole km2 where there are more.
std::string readable_area(double km2) {
  return km2 >= 100 ? fmt::format("{:.0f}", km2) : fmt::format("{:.3g}", km2);
}

std::vector<SheetKey> class_keys(const Zone& zone, const ZoneMap& map) {
  std::uint64_t all = 0;
  for (const ZoneMap::Class& c : map.classes) all += c.cells;
  std::vector<SheetKey> keys{{SheetKey::Sample::kHeading, {}, map.heading + ", and share of the study area"}};
  for (const ZoneMap::Class& c : map.classes) {
    const double km2 = static_cast<double>(c.cells) * zone.grid.cell_area() / 1e6;
    keys.push_back(
        {SheetKey::Sample::kPatch,
         {c.red, c.green, c.blue, c.alpha > 0 ? viewshed::kAlphaOverRelief : std::uint8_t{0}},
         fmt::format("{}: {} km² ({:.1f} %)", c.label, readable_area(km2),
                     100.0 * static_cast<double>(c.cells) / static_cast<double>(std::max<std::uint64_t>(1, all)))});
  }
  return keys;
}

std::string terrain_on_sheet(const StoreMetadata& metadata, const Detail& detail) {
  double spacing = 0;
  for (const SourceInfo& source : metadata.sources)
    if (source.kind == "terrain") spacing = std::max(spacing, source.spacing);
  const std::string posts = spacing > 0 ? fmt::format("posts up to {:.3g} m apart; ", spacing) : "";
  const double tolerance = detail.coarsest();
  return posts + (tolerance > 0 ? fmt::format("generalised to {:g} m", tolerance) : "every point is used");
}

std::string statement_of(const ZoneMap& map, const ZtvSheetFacts& facts) {
  if (!map.screened)
    return "Bare ground: the screening effect of buildings, walls and vegetation is not taken into account. What is "
           "shown as visible may be hidden by them.";
  return fmt::format(
      "Screened: {} as imported are taken as solid. Whatever else stands on the ground is not taken into account.",
      fmt::join(facts.themes, ", "));
}

std::string without_terrain_in_words(const viewshed::MissingGround& missing) {
  if (missing.share() == 0) return "";
  return fmt::format("; {} of it has no terrain data and is not in the percentages", missing.percent());
}

std::string heights_in_words(const Zone& zone) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Turbine& t : zone.request.turbines)
    least = std::min(least, t.tip_height), most = std::max(most, t.tip_height);
  const std::string tips = least == most ? fmt::format("{:g}", most) : fmt::format("{:g} to {:g}", least, most);
  return fmt::format("{}, {} m to blade tip", zone.request.turbines.size(), tips);
}

std::string radii_in_words(const Zone& zone) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Turbine& t : zone.request.turbines) least = std::min(least, t.radius), most = std::max(most, t.radius);
  return least == most
             ? fmt::format("within {:g} km of each turbine", most / 1000)
             : fmt::format("within {:g} to {:g} km of each turbine, by its height", least / 1000, most / 1000);
}

profile::TitleBlock title_block(const Store& store, const Zone& zone, const ZoneMap& map, const SheetOptions& options,
                                const ZtvSheetFacts& facts) {
  const StoreMetadata& metadata = store.metadata();
  profile::TitleBlock block;
  block.project = options.project(), block.date = options.date();
  block.title = map.title + (map.screened ? ", screened" : "");
  block.statement = statement_of(map, facts);
  block.facts = {{"Turbines", heights_in_words(zone)},
                 {"Study area", radii_in_words(zone) + without_terrain_in_words(facts.missing)},
                 {"Observer", fmt::format("eyes {:g} m above the ground at the centre of cells of {:g} m",
                                          zone.request.observer_height, zone.grid.cell_width())},
                 {"Earth", zone.request.earth.curvature
                               ? "curvature and refraction are taken into account, " + zone.request.earth.convention()
                               : "flat; curvature and refraction are not taken into account"},
                 {"Terrain", terrain_on_sheet(metadata, zone.request.detail)},
                 {"Coordinates", crs_title(metadata.crs_wkt)}};
  if (!options.basemap().empty()) block.facts.push_back(basemap_fact(options.basemap()));
  block.sources = described(facts.sources, metadata);
  block.made_by = fmt::format("Drawn by itin {}", ITIN_VERSION);
  return block;
}

}  // namespace

std::vector<viewshed::ZoneFile> write_ztv_sheets(const std::string& folder, const Store& store, const Zone& zone,
                                                 const SheetOptions& options, const ZtvSheetFacts& facts,
                                                 Progress& progress) {
  std::vector<viewshed::ZoneFile> files;
  const std::vector<ZoneMap> maps = viewshed::zone_maps(zone);
  const Furniture furniture(zone, facts);
  std::size_t done = 0;
  for (const profile::PaperSize paper : options.papers()) {
    MapSheet sheet;
    sheet.paper = paper, sheet.scale = options.scale(), sheet.area = study_area(zone);
    sheet.crs_wkt = store.metadata().crs_wkt;
    const MapBase base =
        faded(map_base(store, profile::ground_in_frame(sheet), profile::scale_of(sheet), options.basemap(), progress),
              [&](Point2 p) { return beyond_study_area(zone, p) <= 0; });
    for (const ZoneMap& map : maps) {
      sheet.layers = layers_of(base, classes_of(zone, map));
      sheet.layers.insert(sheet.layers.end(), furniture.layers.begin(), furniture.layers.end());
      sheet.legend = class_keys(zone, map);
      sheet.legend.push_back({SheetKey::Sample::kHeading, {}, "Map"});
      sheet.legend.insert(sheet.legend.end(), furniture.keys.begin(), furniture.keys.end());
      sheet.legend.insert(sheet.legend.end(), base.keys.begin(), base.keys.end());
      sheet.title = title_block(store, zone, map, options, facts);
      for (const std::string& name : sheet_names(map.name, paper)) {
        write_file(fmt::format("{}/{}", folder, name), profile::draw_map_sheet(sheet, name), true);
        files.push_back({name, fmt::format("map sheet: {}, {} at 1:{:.0f}", sheet.title.title, profile::name_of(paper),
                                           profile::scale_of(sheet))});
      }
      progress.report("sheets",
                      static_cast<double>(++done) / static_cast<double>(maps.size() * options.papers().size()));
    }
  }
  return files;
}

}  // namespace itin::cli
