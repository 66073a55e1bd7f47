// itin import: terrain and lines into a store.

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include <itin/coordinates.hpp>
#include <itin/height_limit.hpp>
#include <itin/import.hpp>
#include <itin/store_scale.hpp>

#include "options/memory_option.hpp"
#include "output/store_document.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"

namespace itin::cli {

namespace {

class ImportVerb final : public Verb {
 public:
  std::string name() const override { return "import"; }
  std::string summary() const override { return "Create a store from terrain, or add terrain and lines to it"; }

  void declare(CLI::App& app) override {
    declare_sources(app);
    declare_raised(app);
    declare_features(app);
    declare_terrain(app);
    declare_store(app);
  }

  void validate() override {
    parse_choice("--kind", kind_,
                 {"terrain", "contours", "breaklines", "buildings", "terraces", "vegetation", "walls", "surface",
                  "roads", "water"});
    if (kind_ != "terrain") {
      options_.kind = theme_kind(kind_);
      if (options_.theme.empty()) options_.theme = kind_;
    } else if (!options_.theme.empty()) {
      throw InputError("--theme: terrain has no theme; leave it out");
    }
    validate_raised();
    if (attributes_ == std::vector<std::string>{"none"})
      options_.attributes.emplace();
    else if (!attributes_.empty() && attributes_ != std::vector<std::string>{"all"})
      options_.attributes = attributes_;
    options_.repair = !no_repair_;
    if (!classes_.empty()) options_.classes = parse_wholes("--class", classes_, 0, 255);
    if (!band_.empty()) options_.band = parse_whole("--band", band_, 1, 65535);
    if (!sea_level_.empty()) options_.sea_level = parse_number("--sea-level", sea_level_);
    if (!max_gap_.empty()) options_.max_gap = parse_number("--max-gap", max_gap_, Range::kPositive);
    if (!levels_.empty()) options_.tolerances = growing_levels();
    if (!resolution_.empty()) options_.resolution = parse_number("--resolution", resolution_, Range::kPositive);
    options_.memory_bytes = memory_.bytes().value_or(options_.memory_bytes);
  }

  Document parameters() const override {
    Document parameters{{"store", store_}, {"sources", options_.sources}, {"kind", kind_}};
    const auto given = [&](const char* name, const std::string& value) {
      if (!value.empty()) parameters[name] = value;
    };
    given("theme", options_.theme);
    given("crs", options_.crs);
    given("to_crs", options_.to_crs);
    given("z_field", options_.z_field);
    given("height_field", options_.height_field);
    if (options_.height) parameters["height_m"] = *options_.height;
    given("height_from", options_.height_from);
    if (options_.height_percentile) parameters["height_percentile"] = *options_.height_percentile;
    given("eaves_field", options_.eaves_field);
    given("base_field", options_.base_field);
    given("base", base_);
    given("foundation", foundation_);
    given("roof", roof_);
    if (options_.storey) parameters["storey_m"] = *options_.storey;
    if (options_.thickness) parameters["thickness_m"] = *options_.thickness;
    if (options_.wall_offset) parameters["wall_offset_m"] = *options_.wall_offset;
    if (options_.height_step) parameters["height_step_m"] = *options_.height_step;
    if (options_.height_threshold) parameters["height_threshold_m"] = *options_.height_threshold;
    given("height_rounding", height_rounding_);
    given("source_note", options_.source_note);
    if (!options_.remove.empty()) parameters["remove"] = options_.remove;
    if (options_.band) parameters["band"] = *options_.band;
    given("id_field", options_.id_field);
    given("name_field", options_.name_field);
    if (options_.attributes) parameters["attributes"] = *options_.attributes;
    given("layer", options_.layer);
    given("where", options_.where);
    if (!options_.classes.empty()) parameters["classes"] = options_.classes;
    if (options_.max_gap > 0) parameters["max_gap_m"] = options_.max_gap;
    if (options_.sea_level) parameters["sea_level_m"] = *options_.sea_level;
    given("sea_area", options_.sea_area);
    parameters["replace"] = options_.replace;
    if (options_.stay) parameters["stay"] = true;
    if (options_.kind == ThemeKind::Contours) parameters["repair"] = options_.repair;
    if (!options_.tolerances.empty()) parameters["tolerances_m"] = options_.tolerances;
    parameters["resolution_m"] = options_.resolution;
    return parameters;
  }

  Result execute(Progress& progress) override {
    const ImportReport report =
        options_.kind ? import_lines(store_, options_, progress) : import_terrain(store_, options_, progress);
    const Store store(store_);
    Result result{document(report, store.metadata()), text(report, store.metadata()), report.warnings, {}};
    warn_of_grid(store.metadata(), result.warnings);
    return result;
  }

 private:
  /// Declares the sources, and what their numbers mean.
  void declare_sources(CLI::App& app) {
    begin_group(app, "Sources");
    writes(app.add_option("STORE", store_, "The store, created if there is none")->required());
    reads(app.add_option("SOURCE", options_.sources,
                         "Rasters, point files, LAS, LAZ, or layers of lines and polygons; none is needed where "
                         "--remove is given"));
    app.add_option(
           "--kind", kind_,
           "What the sources are: terrain (default); contours, breaklines or water, which are lines with heights "
           "and become part of the terrain; roads, which are lines on it; buildings, terraces, walls or vegetation, "
           "which stand on it where they have heights (--height-field, --height, CityJSON, rasters of heights above "
           "the ground), and else are lines on it (a building has one base; terraces, walls and vegetation follow the "
           "terrain); surface, a raster of a digital surface model, which stands where it is "
           "above the terrain")
        ->type_name("KIND");
    app.add_option("--theme", options_.theme, "Name of the lines' theme (default: the kind)")->type_name("NAME");
    app.add_option(
           "--remove", options_.remove,
           "Features that stand to take out of the store first, as if they had never been imported: themes, or files "
           "by "
           "the names that itin info has. With the name of the sources' own theme, these take the place of all that it "
           "has")
        ->type_name("NAME,...")
        ->delimiter(',');
    app.add_option("--crs", options_.crs,
                   "CRS of the sources, in place of what they say themselves; a part that it lacks, horizontal or "
                   "vertical, stays theirs")
        ->type_name("CRS");
    app.add_option("--z-field", options_.z_field,
                   "The field or column that holds heights, of points and of lines that are part of the terrain")
        ->type_name("FIELD");
    app.add_option("--layer", options_.layer, "Vector files: the layer to read")->type_name("NAME");
    app.add_option("--where", options_.where, "Vector files: only features that this SQL condition holds for")
        ->type_name("SQL");
    app.add_option("--source-note", options_.source_note,
                   "Product, date and licence of these sources, for the reports of lines over them (default: the "
                   "copyright that a GeoTIFF states)")
        ->type_name("TEXT");
  }

  /// Declares the options about what stands on the terrain, and how high.
  void declare_raised(CLI::App& app) {
    begin_group(app, "What stands on the terrain");
    app.add_option("--height-field", options_.height_field,
                   "Buildings, walls, vegetation: the field of their height above the base, in the unit of the CRS's "
                   "heights (metres or feet)")
        ->type_name("FIELD");
    reads(app.add_option("--height-from", options_.height_from,
                         "Buildings, walls, vegetation: a raster of a digital surface model in the store's CRS, over "
                         "the terrain, from which features have their height that have none in a field")
              ->type_name("FILE"));
    app.add_option(
           "--height-percentile", percentile_,
           "Which of the model's cells within a footprint counts, from 0, the lowest, over 50, their median, to "
           "100, the highest (default: 50)")
        ->type_name("PERCENT");
    app.add_option("--height", height_, "Height of features that have none in the fields and from the model")
        ->type_name("METRES");
    app.add_option("--eaves-field", options_.eaves_field, "Buildings: the field of the eaves' height above the base")
        ->type_name("FIELD");
    app.add_option("--base-field", options_.base_field, "Buildings: the field of the base's elevation")
        ->type_name("FIELD");
    app.add_option("--base", base_,
                   "Buildings: the ground height from which their heights are measured: minimum (default), mean or "
                   "maximum of the terrain under the "
                   "footprint; terrain-following is as mean; CityJSON's own floors count unless this is given. Walls "
                   "reach down to the terrain, and where it rises above a roof, the roof follows it")
        ->type_name("RULE");
    app.add_option("--foundation", foundation_,
                   "Buildings: walls, down to the terrain (default), or flat: the outline lies at the base, and the "
                   "ground slopes to it from the terrain's next vertices, cut away where it is higher")
        ->type_name("KIND");
    app.add_option("--roof", roof_, "Buildings: flat (default), gabled, hipped or skeleton")->type_name("KIND");
    app.add_option("--storey", storey_,
                   "Fields of heights count storeys of this height, as OpenStreetMap's building:levels do")
        ->type_name("METRES");
    app.add_option("--thickness", thickness_, "Thickness of walls and hedges that are given as lines (default: 0.3)")
        ->type_name("METRES");
    app.add_option(
           "--wall-offset", wall_offset_,
           "How far within its outline a feature reaches its full height, as its walls lean inwards by that much: one "
           "value for all features of a theme (default: 0.05, or two steps of --resolution)")
        ->type_name("METRES");
    app.add_option("--height-step", height_step_,
                   "Rasters of buildings, vegetation or a surface: cells stand a multiple of this above the terrain, "
                   "and those of equal height together are a feature; more features take more memory (default: 2)")
        ->type_name("METRES");
    app.add_option("--height-threshold", height_threshold_,
                   "Such rasters: cells that are lower do not stand (default: 2)")
        ->type_name("METRES");
    app.add_option("--height-rounding", height_rounding_,
                   "Such rasters: to the nearest step (default), up, never lower than the raster, or down, never "
                   "higher")
        ->type_name("WAY");
  }

  /// Declares what the store keeps of lines and footprints besides their shape.
  void declare_features(CLI::App& app) {
    begin_group(app, "Names and attributes");
    app.add_option("--id-field", options_.id_field,
                   "Lines, footprints and CityJSON: the field of a feature's id, for exports and reports (default: the "
                   "source's own number or key for it)")
        ->type_name("FIELD");
    app.add_option("--name-field", options_.name_field,
                   "Lines, footprints and CityJSON: the field of a feature's name, for exports, reports and messages")
        ->type_name("FIELD");
    app.add_option(
           "--attributes", attributes_,
           "Lines, footprints and CityJSON: the fields that the store keeps for exports: all (default; numbers, texts, "
           "dates and times), none, or names")
        ->type_name("all|none|FIELD,...")
        ->delimiter(',');
  }

  /// Declares which points are ground, and where ground is.
  void declare_terrain(CLI::App& app) {
    begin_group(app, "Terrain");
    app.add_option("--band", band_, "The band of rasters that holds heights (default: their only one)")->type_name("N");
    app.add_option("--class", classes_, "LAS and LAZ: only these classes (default: all but noise, 7 and 18)")
        ->type_name("C,C...");
    app.add_option("--max-gap", max_gap_,
                   "Scattered points and contours: no ground across wider gaps (default: 100 times their mean spacing)")
        ->type_name("METRES");
    app.add_flag("--allow-mixed-vertical", options_.allow_mixed_vertical,
                 "Take heights as they are, though sources refer to different vertical datums");
    app.add_flag(
        "--no-repair", no_repair_,
        "Contours: infer no points where the triangles of a contour would be flat, in the whole store, whatever "
        "other imports say");
    app.add_flag(
        "--replace", options_.replace,
        "Take the place of terrain that is no finer, and of lines with heights, within the sources' coverage, in "
        "whatever order they come");
    app.add_flag(
        "--stay", options_.stay,
        "Contours, breaklines and water: stay within the coverage of terrain that was imported with --replace, "
        "where such lines make room otherwise, in whatever order they come");
    app.add_option("--sea-level", sea_level_,
                   "Rasters: fill ground that is missing within the box about the sources, voids included, with the "
                   "level sea at this elevation on their datum. Real terrain replaces it, whenever that is imported")
        ->type_name("METRES");
    reads(app.add_option(
                 "--sea-area", options_.sea_area,
                 "Fill only within these polygons, well-known text or a vector file, and all of them, also beyond the "
                 "sources (default: the box about the sources)")
              ->type_name("WKT|FILE"));
  }

  /// Declares what a new store is like, and the memory to work in.
  void declare_store(CLI::App& app) {
    begin_group(app, "The store");
    app.add_option(
           "--to-crs", options_.to_crs,
           "CRS of a new store: projected, in metres, with lengths true to 0.5 % where the sources lie (default: their "
           "own if it is such a one, else their UTM zone)")
        ->type_name("CRS");
    app.add_option("--levels", levels_,
                   "Tolerances of a new store's levels (default: those of 0.5,1,2,4,8,16,32 that are no less than "
                   "--resolution)")
        ->type_name("T,T...");
    app.add_option("--resolution", resolution_, "Grid of a new store's coordinates (default: 0.01)")
        ->type_name("METRES");
    memory_.declare(
        app,
        "Memory to work in, for example 2G. The result does not depend on it, and what needs more is refused "
        "(default: 4G)");
  }

  void validate_raised() {
    if (!height_.empty()) options_.height = parse_height("--height", height_, Range::kPositive);
    if (!percentile_.empty())
      options_.height_percentile = parse_number("--height-percentile", percentile_, Range::kNotNegative);
    if (!storey_.empty()) options_.storey = parse_number("--storey", storey_, Range::kPositive);
    if (!thickness_.empty()) options_.thickness = parse_number("--thickness", thickness_, Range::kPositive);
    if (!wall_offset_.empty()) options_.wall_offset = parse_number("--wall-offset", wall_offset_, Range::kPositive);
    if (!height_step_.empty()) options_.height_step = parse_height("--height-step", height_step_, Range::kPositive);
    if (!height_threshold_.empty())
      options_.height_threshold = parse_height("--height-threshold", height_threshold_, Range::kNotNegative);
    parse_choice("--height-rounding", height_rounding_.empty() ? "nearest" : height_rounding_,
                 {"nearest", "up", "down"});
    if (!height_rounding_.empty()) options_.height_rounding = itin::height_rounding(height_rounding_);
    parse_choice("--roof", roof_.empty() ? "flat" : roof_, {"flat", "gabled", "hipped", "skeleton"});
    if (!roof_.empty()) options_.roof = roof_kind(roof_);
    parse_choice("--base", base_.empty() ? "minimum" : base_, {"minimum", "mean", "maximum", "terrain-following"});
    if (!base_.empty()) options_.base = base_rule(base_);
    parse_choice("--foundation", foundation_.empty() ? "walls" : foundation_, {"walls", "flat"});
    if (!foundation_.empty()) options_.foundation = foundation_ == "flat" ? Foundation::flat : Foundation::walls;
  }

  std::vector<double> growing_levels() const {
    std::vector<double> tolerances = parse_numbers("--levels", levels_, Range::kPositive);
    if (!std::is_sorted(tolerances.begin(), tolerances.end(), std::less_equal<>())) {
      throw InputError(fmt::format("--levels '{}': expected growing tolerances", levels_));
    }
    for (const double tolerance : tolerances) require_height(tolerance, "--levels");
    return tolerances;
  }

  static Document document(const ImportReport& report, const StoreMetadata& metadata) {
    Document document;
    document["crs"] = crs_identifier(metadata.crs_wkt);
    document["crs_chosen"] = report.crs_chosen;
    document["read"] = report.read;
    document["read_features"] = report.read_features;
    document["voids"] = report.voids;
    document["filtered"] = report.filtered;
    document["duplicates"] = report.duplicates;
    document["replaced"] = report.replaced;
    document["line_pieces_replaced"] = report.made_room;
    document["isolated"] = report.isolated;
    document["features"] = report.features;
    document["removed"] = report.removed;
    document["ground_made_again"] = report.ground_made_again.empty() ? Document() : Document(report.ground_made_again);
    document["refused"] = report.refused;
    if (report.cells > 0) {
      document["cells"] = {{"read", report.cells}, {"low", report.low_cells}};
      document["height_error_m"] = {-report.height_error_low, report.height_error_high};
    }
    document["crossings"] = report.crossings;
    document["segments_left_out"] = report.left_out;
    document["flat_triangles"] = {{"before", report.flat_before}, {"after", report.flat_after}};
    document["inferred"] = report.inferred;
    document["vertices"] = report.vertices;
    document["sea_vertices"] = report.sea;
    document["bytes"] = report.store_bytes;
    document["bytes_per_vertex"] = bytes_per_vertex(report);
    document["levels"] = levels_document(metadata);
    document["themes"] = themes_document(metadata);
    document["statistics"] = {{"points_read", report.read}};
    return document;
  }

  std::string text(const ImportReport& report, const StoreMetadata& metadata) const {
    std::string text =
        fmt::format("{}: {} vertices in {}, {:.2f} bytes per vertex, {}{}\n", store_, grouped(report.vertices),
                    readable_bytes(report.store_bytes), bytes_per_vertex(report), report.crs_name,
                    report.crs_chosen ? " (chosen; see --to-crs)" : "");
    text += options_.sources.empty() ? fmt::format("done in {:.1f} s", report.seconds)
                                     : fmt::format("read {} in {:.1f} s", text_of_read(report), report.seconds);
    const auto mention = [&](std::uint64_t count, const char* noun, const char* what) {
      if (count > 0) text += fmt::format(", {} {}", counted(count, noun), what);
    };
    mention(report.voids, "post", "without data");
    if (report.filtered > 0) text += fmt::format(", {} filtered out", grouped(report.filtered));
    if (report.duplicates > 0) text += fmt::format(", {} at the place of another", counted(report.duplicates, "point"));
    if (report.sea > 0) text += fmt::format(", {} of the sea", counted(report.sea, "vertex", "vertices"));
    mention(report.replaced, "point", "replaced");
    mention(report.made_room, "piece", "of lines replaced by finer ground");
    mention(report.isolated, "isolated point", "left out");
    mention(report.removed, "feature", "removed");
    mention(report.refused, "feature", "left out by this and earlier imports");
    mention(report.crossings, "crossing", "resolved");
    mention(report.left_out, "segment", "of lines left out beyond the ground");
    text += flat_text(report) + cells_text(report);
    if (!report.ground_made_again.empty())
      text += fmt::format("\nthe ground was made again, as {}", report.ground_made_again);
    text += metadata.themes.empty() ? "\n\n" : "\n" + themes_table(metadata) + "\n";
    return text + levels_table(metadata);
  }

  static std::string text_of_read(const ImportReport& report) {
    if (report.cells > 0 && report.read_features == 0) return counted(report.cells, "cell");
    if (report.read_features == 0) return counted(report.read, "point");
    return fmt::format("{} with {}", counted(report.read_features, "feature"),
                       counted(report.read, "vertex", "vertices"));
  }

  static std::string cells_text(const ImportReport& report) {
    if (report.cells == 0) return "";
    const double low = report.height_error_low, high = report.height_error_high;
    const std::string error = low == 0    ? fmt::format("0 to {:g} m higher", high)
                              : high == 0 ? fmt::format("0 to {:g} m lower", low)
                                          : fmt::format("up to {:g} m higher or lower", std::max(low, high));
    return fmt::format(
        "\n{} with heights, {} known to be below the threshold; the others stand {} than the raster says",
        counted(report.cells, "cell"), grouped(report.low_cells), error);
  }

  static std::string flat_text(const ImportReport& report) {
    if (report.flat_before == 0) return "";
    if (report.inferred == 0) return fmt::format("\n{} flat triangles of contours", grouped(report.flat_before));
    return fmt::format("\n{} flat triangles of contours, {} after repair with {} inferred points",
                       grouped(report.flat_before), grouped(report.flat_after), grouped(report.inferred));
  }

  static double bytes_per_vertex(const ImportReport& report) {
    return report.vertices == 0 ? 0 : static_cast<double>(report.store_bytes) / static_cast<double>(report.vertices);
  }

  std::string store_;
  std::string kind_ = "terrain";
  bool no_repair_ = false;
  std::string classes_, band_, sea_level_, max_gap_, levels_, resolution_;
  MemoryOption memory_;
  std::string height_, percentile_, base_, foundation_, roof_, storey_, thickness_, wall_offset_, height_step_,
      height_threshold_, height_rounding_;
  std::vector<std::string> attributes_;
  ImportOptions options_;
};

}  // namespace

std::unique_ptr<Verb> make_import_verb() {
  return std::make_unique<ImportVerb>();
}

}  // namespace itin::cli
