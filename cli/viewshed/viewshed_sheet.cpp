#include "viewshed/viewshed_sheet.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/coordinates.hpp>
#include <itin/output_file.hpp>
#include <itin/sources_in.hpp>
#include <viewshed/result_map.hpp>

#include "output/map_base.hpp"
#include "output/store_document.hpp"
#include "viewshed/viewshed_radio.hpp"

namespace itin::cli {

namespace {

using profile::SheetKey;

constexpr profile::SheetColour kObserver{213, 94, 0, 255};

profile::SheetColour drawn(const viewshed::ResultMap::Colour& c) {
  return {c.red, c.green, c.blue, c.alpha};
}

std::vector<SheetKey> keys_of(const viewshed::ResultMap& map) {
  std::vector<SheetKey> keys{{SheetKey::Sample::kHeading, {}, "Share of the cells with terrain data in view"}};
  for (const auto& key : map.keys) keys.push_back({SheetKey::Sample::kPatch, drawn(key.colour), key.text});
  if (map.scale.empty()) return keys;
  keys.push_back({SheetKey::Sample::kHeading, {}, map.scale_title});
  for (const auto& key : map.scale) keys.push_back({SheetKey::Sample::kPatch, drawn(key.colour), key.text});
  return keys;
}

std::string observers_in_words(const viewshed::Request& request) {
  const viewshed::Observer& first = request.observers.front();
  const bool alike = std::all_of(request.observers.begin(), request.observers.end(), [&](const viewshed::Observer& o) {
    return o.height == first.height && o.absolute == first.absolute;
  });
  const std::string count = counted(request.observers.size(), "observer");
  if (!alike) return count + " at heights of their own";
  return fmt::format("{}, {:g} m {}", count, first.height, first.absolute ? "above datum" : "above the ground");
}

std::string statement_of(const Store& store, const viewshed::Request& request) {
  const std::vector<ThemeInfo>& themes = store.metadata().themes;
  if (!request.themes.includes_raised(themes))
    return "Bare ground: the screening effect of buildings, walls and vegetation is not taken into account.";
  return fmt::format("Screening by {} as imported is taken into account; whatever else stands on the ground is not.",
                     fmt::join(request.themes.names(themes), ", "));
}

profile::TitleBlock title_block(const Store& store, const viewshed::Result& result, const SheetOptions& options) {
  const viewshed::Request& request = result.request;
  profile::TitleBlock block;
  block.project = options.project(), block.date = options.date();
  block.title = radio_title(request).value_or(result.certified ? "Certified viewshed" : "Viewshed");
  block.statement = statement_of(store, request);
  block.facts = {{"Observers", observers_in_words(request)},
                 {"Targets", fmt::format("{:g} m {}", request.target_height,
                                         request.target_absolute ? "above datum" : "above the ground")},
                 {"Cells", fmt::format("{:g} m, decided at their centres", result.grid.cell_width())},
                 {"Earth", request.earth.convention()},
                 {"Coordinates", crs_title(store.metadata().crs_wkt)}};
  if (request.radius)
    block.facts.insert(block.facts.begin() + 2, {"Radius", fmt::format("{:g} km", *request.radius / 1000)});
  if (const auto criterion = radio_criterion(request)) block.facts.emplace_back("Radio", *criterion);
  block.sources = described(sources_in(store, result.grid.bounds(), request.themes), store.metadata());
  block.made_by = fmt::format("Drawn by itin {}", ITIN_VERSION);
  return block;
}

}  // namespace

void write_viewshed_sheet(const Store& store, const viewshed::Result& result, const SheetOptions& options,
                          bool overwrite, Progress& progress) {
  if (options.file().empty()) return;
  const viewshed::ResultMap map = viewshed::result_map(result, {});
  profile::MapSheet sheet;
  sheet.paper = options.papers().front(), sheet.scale = options.scale(), sheet.area = result.grid.bounds();
  sheet.crs_wkt = store.metadata().crs_wkt;
  const MapBase base = map_base(store, sheet, progress);
  profile::SheetCells cells{result.grid, {}};
  for (const auto& colour : map.cells) cells.colours.push_back(drawn(colour));
  sheet.layers = {shaded(base.ground,
                         [&](Point2 p) {
                           const auto cell = result.grid.cell_at(p);
                           return cell && result.visible[result.grid.index(*cell)] != viewshed::Verdict::kOutside;
                         }),
                  std::move(cells)};
  sheet.layers.insert(sheet.layers.end(), base.contours.begin(), base.contours.end());
  profile::SheetMarks observers{profile::SheetSymbol::kMast, kObserver, {}};
  for (const viewshed::Observer& o : result.request.observers) observers.marks.push_back({o.position, o.name});
  sheet.layers.emplace_back(std::move(observers));
  sheet.legend = keys_of(map);
  sheet.legend.push_back({SheetKey::Sample::kHeading, {}, "Map"});
  sheet.legend.push_back({SheetKey::Sample::kMast, kObserver, "Observer"});
  sheet.legend.insert(sheet.legend.end(), base.keys.begin(), base.keys.end());
  sheet.title = title_block(store, result, options);
  write_file(options.file(), profile::draw_map_sheet(sheet, options.file()), overwrite);
}

}  // namespace itin::cli
