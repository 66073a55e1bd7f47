#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <itin/coordinates.hpp>
#include <itin/feature_at.hpp>
#include <itin/store.hpp>
#include <itin/table_columns.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/result_parts.hpp>
#include <viewshed/site_plan.hpp>

#include "line/infinity.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

Document of_verdicts(const Result& result, const std::optional<CellsWithoutValue>& without, const auto& value) {
  const CellCounts& cells = result.cells;
  Document document{{"visible", value(cells.visible)},
                    {"hidden", value(cells.hidden)},
                    {"undecided", value(cells.undecided)},
                    {"outside", value(cells.outside)}};
  if (result.request.mode == Mode::kFresnel) document["zone_cut"] = value(cells.zone_cut);
  if (without) document[std::string("without_") + without->value] = value(without->cells);
  return document;
}

/// The columns of the sky line. In directions without one, they are empty.
std::vector<TableColumn<HorizonPoint>> sky_line_columns(const StoreMetadata& metadata) {
  std::vector<TableColumn<HorizonPoint>> columns{{"azimuth_deg", &HorizonPoint::azimuth_deg, kInAllFormats, "{:.10g}"}};
  const auto add = [&](const char* name, auto of, const char* number = "{:.3f}") {
    columns.emplace_back(
        name, [of](const HorizonPoint& p) { return if_any(p.sky, of); }, kInAllFormats, number);
  };
  add("elevation_deg", &SkyPoint::elevation_deg, "{:.6f}");
  add("distance_m", &SkyPoint::distance_m);
  add("x", [](const SkyPoint& sky) { return sky.position.x; });
  add("y", [](const SkyPoint& sky) { return sky.position.y; });
  add("z", [](const SkyPoint& sky) { return sky.position.z; });
  add("theme", [&metadata](const SkyPoint& sky) {
    return sky.theme == 0 ? "terrain" : metadata.themes[sky.theme - std::size_t{1}].name;
  });
  add("data_edge", &SkyPoint::data_edge, kFlagsAsNumbers);
  columns.emplace_back(
      "over_missing",
      [](const HorizonPoint& p) { return if_any(p.sky, [&](const SkyPoint&) { return p.over_missing; }); },
      kInAllFormats, kFlagsAsNumbers);
  return columns;
}

}  // namespace

Document grid_document(const RasterGrid& grid) {
  return {{"bounds", box_document(grid.bounds())},
          {"columns", grid.columns()},
          {"rows", grid.rows()},
          {"cell_m", {grid.cell_width(), grid.cell_height()}}};
}

Document statistics_document(const Statistics& statistics) {
  Document document = itin::statistics_document(statistics.retrieval, statistics.triangles);
  document["lines"] = statistics.lines;
  return document;
}

double decided_percent(const CellCounts& cells) {
  const std::uint64_t decided = cells.visible + cells.hidden, all = decided + cells.undecided;
  return all == 0 ? 100 : 100.0 * static_cast<double>(decided) / static_cast<double>(all);
}

namespace {

/// What a mode calls the value that not every cell in view has, and the values; nothing for modes without such a one.
std::optional<std::pair<const char*, const std::vector<float>*>> value_that_may_lack(const ModeValues& values) {
  if (const auto* of = std::get_if<LeastHeights>(&values)) return {{"height", &of->height_m}};
  if (const auto* of = std::get_if<Probabilities>(&values)) return {{"probability", &of->probability}};
  if (const auto* of = std::get_if<Losses>(&values)) return {{"loss", &of->diffraction_db}};
  if (const auto* of = std::get_if<Levels>(&values)) return {{"level", &of->level_dbm}};
  return std::nullopt;
}

}  // namespace

std::optional<CellsWithoutValue> cells_without_value(const Result& result) {
  const auto value = value_that_may_lack(result.values);
  if (!value) return std::nullopt;
  CellsWithoutValue cells{value->first};
  for_each_part(result, [&](const Result& part, RasterGrid::Cell) {
    const std::vector<float>& values = *value_that_may_lack(part.values)->second;
    for (std::size_t i = 0; i < values.size(); ++i)
      cells.cells += std::isnan(values[i]) && part.visible[i] != Verdict::kOutside ? 1 : 0;
  });
  return cells;
}

std::vector<CellsWithMargin> cells_with_margins(const Result& result) {
  if (!std::holds_alternative<Levels>(result.values) || !result.request.budget.sensitivity_dbm) return {};
  const std::vector<ValueBand> bands = level_bands(result.request);
  std::vector<std::uint64_t> cells(bands.size());
  for_each_part(result, [&](const Result& part, RasterGrid::Cell) {
    for (const float level : part.get<Levels>().level_dbm)
      if (!std::isnan(level)) ++cells[band_of(bands, level)];
  });
  const std::vector<double> none{0}, &margins = result.request.margins_db.empty() ? none : result.request.margins_db;
  std::vector<CellsWithMargin> with;
  for (std::size_t i = 0; i < margins.size(); ++i)
    with.push_back(
        {margins[i], i + 1,
         std::accumulate(cells.begin() + static_cast<std::ptrdiff_t>(i) + 1, cells.end(), std::uint64_t{0})});
  return with;
}

std::vector<CellsOfObserver> cells_of_observers(const Result& result) {
  const std::size_t observers = result.request.observers.size();
  if (!std::holds_alternative<Levels>(result.values) || observers < 2) return {};
  const std::optional<double>& sensitivity = result.request.budget.sensitivity_dbm;
  const double least = sensitivity.value_or(-kInfinity);
  std::vector<CellsOfObserver> of(observers);
  for (std::size_t i = 0; i < observers; ++i) of[i].observer = i;
  for_each_part(result, [&](const Result& part, RasterGrid::Cell) {
    const auto& levels = part.get<Levels>();
    for (std::size_t cell = 0; cell < levels.observer.size(); ++cell)
      if (const std::uint32_t number = levels.observer[cell]; number > 0 && levels.level_dbm[cell] >= least)
        ++of[number - 1].cells;
  });
  return of;
}

Document viewshed_document(const StoreMetadata& metadata, const Result& result) {
  const Request& request = result.request;
  const double area = result.grid.cell_area();
  Document document;
  document["crs"] = crs_identifier(metadata.crs_wkt);
  document["surface"] = surface_document(metadata, request.detail, request.themes);
  document["refraction"] = earth_document(request.earth);
  document["grid"] = grid_document(result.grid);
  const std::optional<CellsWithoutValue> without = cells_without_value(result);
  document["cells"] = of_verdicts(result, without, [](std::uint64_t cells) { return cells; });
  document["area_m2"] =
      of_verdicts(result, without, [&](std::uint64_t cells) { return static_cast<double>(cells) * area; });
  for (const CellsWithMargin& with : cells_with_margins(result))
    document["margins"].push_back(
        {{"margin_db", with.margin_db}, {"cells", with.cells}, {"area_m2", static_cast<double>(with.cells) * area}});
  for (const CellsOfObserver& of : cells_of_observers(result))
    document["served_best"].push_back({{"observer", request.observers[of.observer].name},
                                       {"cells", of.cells},
                                       {"area_m2", static_cast<double>(of.cells) * area}});
  if (result.certified) {
    document["decided_percent"] = decided_percent(result.cells);
    document["decided_exactly"] = result.decided_exactly;
  }
  document["statistics"] = statistics_document(result.statistics);
  return document;
}

Document blockers_document(const Store& store, const Result& result) {
  std::map<std::uint16_t, std::map<std::int64_t, std::uint64_t>> hidden;  // cells by theme and feature
  const auto& cells_hidden_by = result.get<Blockers>();
  for (std::size_t cell = 0; cell < cells_hidden_by.feature.size(); ++cell)
    if (cells_hidden_by.feature[cell] != kNoBlocker)
      ++hidden[static_cast<std::uint16_t>(cells_hidden_by.theme[cell])][cells_hidden_by.feature[cell]];
  std::vector<std::pair<std::uint64_t, Document>> blockers;
  for (const auto& [theme, of_features] : hidden) {
    std::vector<std::int64_t> numbers;
    for (const auto& [number, cells] : of_features) numbers.push_back(number);
    const auto found = features_numbered(store, theme, numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const bool has_id = found[i] && !found[i]->id.empty();
      const std::uint64_t cells = of_features.at(numbers[i]);
      blockers.push_back({cells,
                          {{"theme", store.metadata().themes[theme - std::size_t{1}].name},
                           {"feature", found[i] ? Document(found[i]->name) : Document(nullptr)},
                           {"feature_number", numbers[i]},
                           {"feature_id", has_id ? Document(found[i]->id) : Document(nullptr)},
                           {"cells", cells}}});
    }
  }
  std::stable_sort(blockers.begin(), blockers.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Document document = Document::array();
  for (auto& [cells, blocker] : blockers) document.push_back(std::move(blocker));
  return document;
}

void add_missing_ground(const MissingGround& missing, Document& document) {
  document["cells"]["no_data"] = missing.without_ground;
  document["area_m2"]["no_data"] = static_cast<double>(missing.without_ground) * missing.cell_area;
  document["area_m2"]["beyond_the_data"] = static_cast<double>(missing.beyond) * missing.cell_area;
  document["share_without_data"] = missing.share();
}

std::string horizon_csv(const Horizon& horizon, const StoreMetadata& metadata) {
  return csv_of(sky_line_columns(metadata), horizon.points);
}

Document outputs_document(const std::vector<PlanFile>& files) {
  Document outputs = Document::array();
  for (const PlanFile& file : files) outputs.push_back({{"path", file.path}, {"what", file.what}});
  return outputs;
}

Document targets_document(const Horizon& horizon) {
  Document targets = Document::array();
  for (const SightedTarget& t : horizon.targets) {
    const bool visible = t.verdict == Verdict::kVisible, undecided = t.verdict == Verdict::kUndecided;
    targets.push_back({{"name", t.target.name},
                       {"x", t.target.position.x},
                       {"y", t.target.position.y},
                       {"elevation_m", t.elevation_m},
                       {"azimuth_deg", t.azimuth_deg},
                       {"elevation_deg", t.elevation_deg},
                       {"distance_m", t.distance_m},
                       {"verdict", visible     ? "visible"
                                   : undecided ? "undecided"
                                               : "hidden"},
                       {"visible", undecided ? Document() : Document(visible)}});
  }
  return targets;
}

std::string json_of(const Result& result, const StoreMetadata& metadata) {
  return result_text(viewshed_document(metadata, result));
}

std::string json_of(const Horizon& horizon, const Request& request, const StoreMetadata& metadata) {
  const Observer& observer = request.observers.front();
  return result_text({{"crs", crs_identifier(metadata.crs_wkt)},
                      {"surface", surface_document(metadata, request.detail, request.themes)},
                      {"observer",
                       {{"name", observer.name},
                        {"x", observer.position.x},
                        {"y", observer.position.y},
                        {"elevation_m", horizon.eye_elevation_m}}},
                      {"refraction", earth_document(request.earth)},
                      {"sky_line", documents_of(sky_line_columns(metadata), horizon.points)},
                      {"targets", targets_document(horizon)}});
}

}  // namespace itin::viewshed
