#include "site/site_options.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>
#include <itin/site_list.hpp>

#include "options/half_posting.hpp"
#include "options/places/mast_file.hpp"
#include "options/places/taken_heights.hpp"
#include "options/radio/wave_options.hpp"
#include "options/radius_preset.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/unusable_options.hpp"

namespace itin::cli {

namespace {

std::optional<double> number(const char* option, const std::string& text, Range range) {
  return text.empty() ? std::nullopt : std::optional(parse_number(option, text, range));
}

}  // namespace

void SiteOptions::declare(CLI::App& app) {
  app_ = &app;
  reads(app.add_option("STORE", store, "The store")->required());
  declare_candidates(app);
  placement.declare(app);
  declare_demand(app);
  declare_antennas(app);
  declare_radios(app);
  declare_choice(app);
  declare_outputs(app);
  declare_work(app);
}

void SiteOptions::declare_candidates(CLI::App& app) {
  begin_group(app, "Candidates");
  declare_mast_file(app, {"--candidates", "Candidates", "the row's number from 0"}, candidates);
  app.add_option("--cost-field", cost_field, "The field that holds each place's cost (default: no costs)")
      ->type_name("FIELD");
  reads(app.add_option("--search-area", search_area,
                       "Propose candidates in these polygons (a file, or WKT) from the terrain")
            ->type_name("AREA"));
  app.add_option("--spacing", spacing_text_,
                 "Propose about two candidates in each square of this side; with --turbines one, in its middle")
      ->type_name("METRES");
  app.add_option("--mast-height", mast_height_text_, "Height of the masts, or several to choose from (default: 20)")
      ->type_name("H[,H...]");
  app.add_option("--mast-cost", mast_cost_text_,
                 "Cost of each mast height, added to the cost of the place (default: 1, with --cost-field 0)")
      ->type_name("C[,C...]");
  app.add_option("--observer-on", observer_on_,
                 "Masts stand on the ground (default), or on the roofs of --themes, which are then proposed, too")
      ->type_name("ground|surface");
  in_crs.declare(app);
}

void SiteOptions::declare_demand(CLI::App& app) {
  begin_group(app, "Demand");
  reads(app.add_option("--demand", demand,
                       "What is to be served: cells (the default), which are those within the radius of a candidate, "
                       "premises (the buildings of --themes, on their walls and roofs), a raster of weights, or a "
                       "vector file of points")
            ->type_name("cells|premises|FILE"));
  app.add_option("--weight-field", weight_field, "The field of the points that holds weights (default: 1 each)")
      ->type_name("FIELD");
  app.add_option("--target-height", target_height_text_,
                 "Height of the targets above what they stand on (default: the field height of points, else 2)")
      ->type_name("METRES");
  app.add_option("--target-on", target_on_, "ground (default), or the surface with the roofs and tops of --themes")
      ->type_name("ground|surface");
  app.add_option(
         "--frequency", frequency_text_,
         "Serve only what is in sight with its first Fresnel zone clear at this frequency; links are judged so, too")
      ->type_name("GHZ");
  declare_fresnel(app, fresnel_text_);
  app.add_option(
         "--radius", radius_text_,
         "How far a site serves (default: 10000), or turbines are looked for (default: by their tips, as ztv has "
         "it)")
      ->type_name("METRES");
  app.add_option(
         "--cell", cell_text_,
         "Size of the cells of the demand and of the rasters (default: 50); unasked they are no finer than half the "
         "posting of bare ground")
      ->type_name("METRES");
}

void SiteOptions::declare_antennas(CLI::App& app) {
  begin_group(app, "Antennas, with --demand premises");
  antennas.declare(app, "--place-spacing");
}

void SiteOptions::declare_radios(CLI::App& app) {
  radios.declare(app, {"a site", "the receiver", false});
  app.add_option("--margin-db", margin_text_,
                 "With a link budget, a target is served, in sight or not, where its level is the sensitivity and this "
                 "much more (default: 0); links among sites are judged by sight and --fresnel still")
      ->type_name("DB");
}

void SiteOptions::declare_choice(CLI::App& app) {
  begin_group(app, "Choice");
  app.add_option("--count", count_text_, "How many sites to choose, or turbines to place")->type_name("K");
  app.add_option("--budget", budget_text_, "Choose sites whose costs add up to at most this")->type_name("COST");
  app.add_option("--share", share_text_, "Choose sites until this share of the demand is served (0.8, or 80%)")
      ->type_name("SHARE");
  app.add_option("--min-spacing", min_spacing_text_, "No two chosen sites are nearer to each other than this")
      ->type_name("METRES");
  reads(app.add_option("--existing", existing,
                       "Sites that serve already, from a vector file; their heights are in --height-field, or else in "
                       "height; those without one have the first of --mast-height")
            ->type_name("FILE"));
  reads(app.add_option("--forbidden", forbidden, "No site in these polygons (a file, or WKT)")->type_name("AREA"));
  app.add_option("--k-cover", cover_text_, "How many sites must serve a target for it to count as served (default: 1)")
      ->type_name("N");
  app.add_flag(
      "--intervisible", request.intervisible,
      "Chosen sites reach each other by links between them and existing ones that are certainly in sight; sites may be "
      "chosen as relays alone");
  app.add_option("--hub", hub_text_, "Chosen sites reach this place by such links (implies --intervisible)")
      ->type_name("x,y[,h]");
  app.add_option(
         "--exact-final", exact_final_text_,
         "on (default): the coverage of the chosen sites is exact; off: it may be told by bounds, and no sites are "
         "exchanged")
      ->type_name("on|off");
  app.add_option("--swap", swap_text_, "Exchange chosen sites for better ones after the first selection (default: on)")
      ->type_name("on|off");
}

void SiteOptions::declare_outputs(CLI::App& app) {
  begin_group(app, kOutputs);
  writes(app.add_option("-o,--output", directory, "The folder to write into; made where it is not there")
             ->type_name("DIR")
             ->required());
  policy.declare(app);
  sheets.declare(app);
}

void SiteOptions::declare_work(CLI::App& app) {
  begin_group(app, kSurface);
  app.add_option(
         "--tolerance", tolerance_text_,
         "Tolerance of the terrain for the first estimate of all candidates; the choice is made on exact coverage "
         "all the same (default: by size; no estimate where --memory holds the terrain, as exact coverage takes no "
         "longer)")
      ->type_name("METRES");
  themes.declare(app);
  earth.declare(app);
  nodata.declare(
      app,
      "What ground without data does to a sight line: unknown (default) leaves it undecided unless known "
      "ground hides it; what is undecided neither serves nor links, and with --turbines it counts as seen; block "
      "hides the target, clear lets it pass");
  engine.declare(app);
  memory.declare(app, kReadInParts);
  reads(app.add_option("--params", params_, "Options from a JSON file, by name; those of the call come before them")
            ->type_name("FILE"));
  app.add_flag("--resume", resume, "Go on where a run with the same parameters was killed");
}

void SiteOptions::validate() {
  sheets.validate(demand == "premises");
  placement.validate();
  validate_candidates();
  validate_masts();
  validate_demand();
  validate_choice();
  validate_work();
  validate_links();
}

void SiteOptions::validate_candidates() {
  if (candidates.path.empty() == search_area.empty())
    throw InputError("give either --candidates FILE, or --search-area AREA --spacing METRES");
  const std::optional<double> spacing = number("--spacing", spacing_text_, Range::kPositive);
  if (search_area.empty() && spacing) throw InputError("--spacing works only with --search-area");
  if (!search_area.empty() && !spacing) throw InputError("--search-area: give --spacing METRES too");
  request.spacing = spacing.value_or(request.spacing);
  if (candidates.path.empty()) {
    for (const std::string* text :
         {&candidates.layer, &candidates.where, &candidates.name_field, &candidates.height_field, &cost_field})
      if (!text->empty()) throw InputError("--layer, --where and fields work only with --candidates");
  }
  request.on_surface = parse_choice("--observer-on", observer_on_, {"ground", "surface"}) == 1;
}

void SiteOptions::validate_masts() {
  if (!candidates.height_field.empty() && !mast_height_text_.empty())
    throw InputError("--height-field and --mast-height exclude each other");
  if (placement.given()) {
    request.turbines = placement.placement();
    return;
  }
  const std::vector<double> heights = mast_height_text_.empty()
                                          ? std::vector<double>{20}
                                          : parse_heights("--mast-height", mast_height_text_, Range::kNotNegative);
  // Where candidates have costs, a mast has none unless one is given.
  std::vector<double> costs(heights.size(), cost_field.empty() ? 1 : 0);
  if (!mast_cost_text_.empty()) costs = parse_numbers("--mast-cost", mast_cost_text_, Range::kNotNegative);
  if (costs.size() != heights.size())
    throw InputError(fmt::format("--mast-cost: {} for {}; give each height its cost", counted(costs.size(), "cost"),
                                 counted(heights.size(), "height")));
  request.masts.clear();
  for (std::size_t i = 0; i < heights.size(); ++i) request.masts.push_back({heights[i], costs[i]});
}

void SiteOptions::validate_demand() {
  if (!target_height_text_.empty())
    request.demand.height = parse_height("--target-height", target_height_text_, Range::kNotNegative);
  request.demand.on_surface = parse_choice("--target-on", target_on_, {"ground", "surface"}) == 1;
  if (placement.given()) {
    RadiusOptions by_tip;
    by_tip.validate();
    request.radius = by_tip.rule().radius(request.turbines->tip_height);
  }
  if (!radius_text_.empty()) request.radius = parse_radius("--radius", radius_text_);
  const std::optional<double> cell = number("--cell", cell_text_, Range::kPositive);
  if (cell.value_or(0) > request.radius)
    throw InputError(fmt::format("--cell '{}': larger than the radius; give a smaller one", cell_text_));
  request.cell_size = cell.value_or(request.cell_size);
  if (demand == "premises") {
    if (placement.given()) throw InputError("--turbines are not placed for --demand premises: give cells or points");
    antennas.validate();
    request.demand.premises = antennas.places();
  } else {
    require_not_given(*app_, {"--place-spacing", "--reveal", "--storey", "--pole"},
                      "works only with --demand premises");
  }
  if (!reads_demand() && !weight_field.empty())
    throw InputError("--weight-field works only with points: give them by --demand FILE");
}

void SiteOptions::validate_links() {
  if (!frequency_text_.empty()) request.frequency_ghz = parse_frequency(frequency_text_);
  require_frequency_of_zone(fresnel_text_, request.frequency_ghz.has_value());
  validate_radios();
  if (!request.frequency_ghz) return;
  if (!fresnel_text_.empty()) request.fresnel = parse_fresnel(fresnel_text_);
  require_curved(earth.earth());
  if (request.by_level()) return;
  // A Fresnel zone that ends on the ground has no clearance at all.
  if (request.demand.height == 0)
    throw InputError("--frequency needs a --target-height above 0: no link to the ground is clear");
  for (const viewshed::Mast& mast : request.masts)
    if (mast.height == 0)
      throw InputError("--frequency needs a --mast-height above 0: no link from the ground is clear");
}

void SiteOptions::validate_radios() {
  radios.validate();
  request.link_budget = radios.query();
  std::optional<RadioPath> wave;
  if (request.frequency_ghz) wave.emplace().frequency_ghz = *request.frequency_ghz;
  radios.require_frequency(wave);
  if (margin_text_.empty()) return;
  if (!radios.given()) throw InputError("--margin-db works only with a link budget: give --power-dbm or --eirp-dbm");
  request.margin_db = parse_number("--margin-db", margin_text_, Range::kAny);
}

void SiteOptions::take_posting(const StoreMetadata& metadata) {
  if (cell_text_.empty()) request.cell_size = std::max(request.cell_size, half_posting(metadata, themes.choice()));
}

void SiteOptions::take_fields(std::vector<std::string>& warnings) {
  take_demand_heights(warnings);
  existing_height_field = candidates.height_field;
  if (placement.given()) return;
  if (!candidates.path.empty() && candidates.height_field.empty()) {
    take_heights(candidates, LayerFields(candidates),
                 {mast_height_text_.empty() ? "" : "--mast-height", "--height-field"}, warnings);
    took_heights_ = !candidates.height_field.empty();
  }
  if (existing.empty() || !existing_height_field.empty()) return;
  SiteQuery standing;
  standing.path = existing;
  take_heights(standing, LayerFields(standing), {"", "--height-field"}, warnings);
  existing_height_field = standing.height_field;
}

void SiteOptions::take_demand_heights(std::vector<std::string>& warnings) {
  if (!reads_demand() || is_raster(demand)) return;
  SiteQuery points;
  points.path = demand;
  take_heights(points, LayerFields(points), {target_height_text_.empty() ? "" : "--target-height", "", {weight_field}},
               warnings);
  demand_height_field = points.height_field;
}

std::string SiteOptions::heights_text() const {
  return taken_heights_text("masts", took_heights_ ? candidates.height_field : "", candidates.path) +
         taken_heights_text("targets", demand_height_field, demand);
}

void SiteOptions::validate_choice() {
  if (!count_text_.empty()) request.count = static_cast<std::size_t>(parse_whole("--count", count_text_, 1, 100000));
  request.budget = number("--budget", budget_text_, Range::kPositive);
  if (!share_text_.empty()) {
    const bool percent = share_text_.back() == '%';
    const std::string digits = percent ? share_text_.substr(0, share_text_.size() - 1) : share_text_;
    request.share = parse_number("--share", digits, Range::kPositive) / (percent ? 100 : 1);
    if (*request.share > 1) throw InputError(fmt::format("--share '{}': more than all; give 0.8 or 80%", share_text_));
  }
  if (!request.count && !request.budget && !request.share)
    throw InputError("nothing says how many sites to choose: give --count, --budget or --share");
  request.min_spacing = number("--min-spacing", min_spacing_text_, Range::kPositive);
  if (!cover_text_.empty()) request.cover = parse_whole("--k-cover", cover_text_, 1, 255);
  if (!hub_text_.empty()) hub = parse_place("--hub", hub_text_);
  if (hub) request.hub.emplace();
  if (!exact_final_text_.empty()) request.exact_chosen = parse_switch("--exact-final", exact_final_text_);
  if (!swap_text_.empty()) request.swaps = parse_switch("--swap", swap_text_);
}

void SiteOptions::validate_work() {
  request.tolerance = number("--tolerance", tolerance_text_, Range::kNotNegative);
  themes.validate();
  earth.validate();
  request.engine = engine.engine();
  request.nodata = nodata.rule();
  request.memory_bytes = memory.bytes().value_or(request.memory_bytes);
}

Document SiteOptions::parameters() const {
  Document p{{"store", store}};
  if (!candidates.path.empty()) p["candidates"] = candidates.path;
  if (!search_area.empty()) p["search_area"] = search_area, p["spacing_m"] = request.spacing;
  if (placement.given()) {
    p["turbines"] = true;
    p.update(placement.parameters());
  } else if (candidates.height_field.empty()) {
    for (const viewshed::Mast& mast : request.masts)
      p["masts"].push_back({{"height_m", mast.height}, {"cost", mast.cost}});
  } else {
    p["height_field"] = candidates.height_field;
  }
  if (!cost_field.empty()) p["cost_field"] = cost_field;
  p["observer_on"] = observer_on_;
  p["demand"] = demand;
  if (demand == "premises") p["antennas"] = antennas.parameters();
  p["target_height_m"] = request.demand.height;
  if (!demand_height_field.empty()) p["demand_height_field"] = demand_height_field;
  p["target_on"] = target_on_;
  p["radius_m"] = request.radius;
  p["cell_m"] = request.cell_size;
  if (request.frequency_ghz) p["frequency_ghz"] = *request.frequency_ghz, p["fresnel"] = request.fresnel;
  if (request.by_level()) p.update(radios.parameters()), p["margin_db"] = request.margin_db;
  if (request.count) p["count"] = *request.count;
  if (request.budget) p["budget"] = *request.budget;
  if (request.share) p["share"] = *request.share;
  if (request.min_spacing) p["min_spacing_m"] = *request.min_spacing;
  if (!existing.empty()) p["existing"] = existing;
  if (!existing_height_field.empty()) p["existing_height_field"] = existing_height_field;
  if (!forbidden.empty()) p["forbidden"] = forbidden;
  p["k_cover"] = request.cover;
  p["intervisible"] = request.has_links();
  if (hub)
    p["hub"] = {{"x", hub->position.x},
                {"y", hub->position.y},
                {"height_m", hub->height.value_or(viewshed::SitePlanRequest::kHubHeight)}};
  p["exact_final"] = request.exact_chosen;
  p["swap"] = request.swaps;
  p.update(themes.parameters());
  p["nodata"] = nodata.text();
  return p;
}

}  // namespace itin::cli
