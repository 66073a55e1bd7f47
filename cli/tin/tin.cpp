// itin tin: the triangulation of a window.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/cell_heights.hpp>
#include <itin/coordinates.hpp>
#include <itin/document.hpp>
#include <itin/error.hpp>
#include <itin/store.hpp>
#include <itin/store_scale.hpp>
#include <itin/tin_export.hpp>
#include <itin/triangulate.hpp>
#include <itin/vector_export.hpp>

#include "options/detail_options.hpp"
#include "options/memory_option.hpp"
#include "options/picture_options.hpp"
#include "options/places/window_options.hpp"
#include "options/surface_options.hpp"
#include "output/output_path.hpp"
#include "output/store_document.hpp"
#include "output/tin_export_options.hpp"
#include "program/call_files.hpp"
#include "program/help.hpp"
#include "program/values.hpp"
#include "program/verb.hpp"
#include "tin/surface_raster.hpp"

namespace itin::cli {

namespace {

class TinVerb final : public Verb {
 public:
  std::string name() const override { return "tin"; }
  std::string summary() const override { return "Write the triangulation of a window"; }

  void declare(CLI::App& app) override {
    reads(app.add_option("STORE", store_, "The store")->required());
    window_.declare(app);
    begin_group(app, kOutputs);
    writes(
        app.add_option("-o,--output", output_,
                       "What to write: triangles (.ply, .obj, .glb, .gpkg, .geojson; .2dm, a mesh layer for QGIS), a "
                       "topology (.json), or the heights of the surface as a raster (.tif)")
            ->type_name("FILE"));
    surface_.declare(app);
    app.add_option("--topology", topology_, "Write this structure of the triangulation: triangle, vertex or edge")
        ->type_name("KIND");
    app.add_option("--lines", lines_,
                   "Write the lines of these themes in place of triangles, each feature's with its id, name and "
                   "attributes; those of the terrain simplified to the tolerance (.gpkg or .geojson)")
        ->type_name("THEME,...")
        ->delimiter(',');
    picture_.declare(app, "the surface");
    detail_.declare(app, "the middle of the window (the centre of a disc, the apex of a wedge)");
    themes_.declare(app);
    memory_.declare(
        app, "Memory to work in, for example 2G; a window or a raster that needs more is refused (default: no limit)");
    policy_.declare(app);
  }

  void validate() override {
    window_.validate();
    detail_.validate();
    themes_.validate();
    memory_.bytes();
    if (output_.empty() && picture_.path().empty())
      throw InputError("give an output: --output FILE, or --image FILE.png");
    if (output_.empty() && !topology_.empty()) throw InputError("--topology: give --output FILE.json with it");
    picture_.validate();
    if (!topology_.empty()) kind_ = topology_kind(topology_);
    if (!lines_.empty() && output_.empty())
      throw InputError("--lines: give --output FILE.gpkg or FILE.geojson with it");
    if (!lines_.empty() && kind_) throw InputError("--lines and --topology write different files: give one of them");
    surface_.validate(output_);
    if (names_geotiff(output_) && (kind_ || !lines_.empty() || !picture_.path().empty()))
      throw InputError(
          fmt::format("--output '{}': --image, --lines and --topology are about triangles; give them in "
                      "another call",
                      output_));
  }

  Document parameters() const override {
    Document parameters{{"store", store_}};
    if (!output_.empty()) parameters["output"] = output_;
    if (!picture_.path().empty()) parameters["image"] = picture_.path();
    parameters.update(query());
    return parameters;
  }

  Result execute(Progress& progress) override {
    for (const std::string& path : outputs()) policy_.require_writable(path);
    require_format();
    const Store store(store_, cache_within(memory_.bytes()));
    require_crs_for(output_, store.metadata().crs_wkt);
    const auto [window, centre] = window_.region(store.metadata());
    const Detail detail = detail_.detail(centre);
    themes_.complete(store, progress);
    const ThemeChoice themes = themes_.choice().with_ground_lines();
    themes.check(store.metadata().themes);
    if (names_geotiff(output_)) return write_raster_of(store, window, detail, themes, progress);
    const std::vector<std::uint16_t> lines = line_themes(store.metadata(), themes);
    require_memory(points_about(store, window, detail, themes));
    const Tin tin = triangulate(store, window, detail, progress, themes);
    if (tin.triangles.empty() && !picture_.path().empty())
      throw InputError(window_.no_ground(store.metadata()) + "; there is nothing to draw");
    if (tin.triangles.empty() && std::filesystem::exists(output_))
      throw InputError(fmt::format("{}; '{}' stays as it was", window_.no_ground(store.metadata()), output_));
    const Document surface = surface_document(store.metadata(), detail, themes);
    Result result;
    if (!output_.empty()) write(store, {tin, window, detail, lines}, surface, progress, result.warnings);
    if (!picture_.path().empty()) picture_.write(store, tin, detail, policy_.overwrite, progress);
    result.document = document(tin, store.metadata(), surface), result.text = text(tin);
    warn_of_grid(store.metadata(), result.warnings);
    if (tin.triangles.empty()) result.warnings.push_back(window_.no_ground(store.metadata()));
    return result;
  }

 private:
  /// Throws where the output cannot be written in the form that is asked for.
  void require_format() const {
    if (kind_) {
      require_topology_output(output_, policy_.overwrite);
    } else if (!lines_.empty()) {
      require_lines_output(output_, policy_.overwrite);
    } else if (!output_.empty() && !names_geotiff(output_)) {
      require_tin_output(output_, policy_.overwrite);
    }
  }

  Result write_raster_of(const Store& store, const Window& window, const Detail& detail, const ThemeChoice& themes,
                         Progress& progress) const {
    const StoreMetadata& metadata = store.metadata();
    const RasterGrid grid = surface_.grid(metadata, window, window_.no_ground(metadata), memory_.bytes());
    const CellHeights heights = cell_heights(store, {grid, window}, detail, themes, progress);
    const Document surface = surface_document(metadata, detail, themes);
    RasterDescription description;
    description.crs_wkt = metadata.crs_wkt;
    description.nodata = std::numeric_limits<double>::quiet_NaN();
    description.band_name = "elevation of the surface, metres";
    description.metadata = {{"itin", ITIN_VERSION}, {"surface", json_text(surface)}};
    description.overwrite = policy_.overwrite;
    write_raster(output_, grid, std::span<const float>(heights.metres), description, progress);
    Result result;
    result.document["crs"] = crs_identifier(metadata.crs_wkt);
    result.document["surface"] = surface;
    const std::string cells = describe(grid, heights, result.document);
    result.document["outputs"] = outputs();
    result.document["statistics"] = {{"points_read", heights.statistics.points_read},
                                     {"blocks_read", heights.statistics.blocks_read}};
    result.text = fmt::format("{}: {}, {}\n{}", output_, cells, readable_bytes(std::filesystem::file_size(output_)),
                              read_in_words(heights.statistics));
    warn_of_grid(metadata, result.warnings);
    return result;
  }

  static std::string read_in_words(const RetrievalStatistics& read) {
    return fmt::format("read {} in {}\n", counted(read.points_read, "point"), counted(read.blocks_read, "block"));
  }

  /// The query without the names of files, on which the output must not depend.
  Document query() const {
    Document query = window_.parameters();
    query.update(detail_.parameters());
    query.update(themes_.parameters());
    query.update(surface_.parameters());
    if (kind_) query["topology"] = topology_;
    if (!lines_.empty()) query["lines"] = lines_;
    return query;
  }

  /// Throws InputError where the memory does not hold the triangulation of this number of points, and what is made of
  /// it.
  void require_memory(std::uint64_t points) const {
    constexpr std::uint64_t kMesh = 180, kTopology = 300;  ///< bytes per point at the peak, measured
    constexpr std::uint64_t kPicture = std::uint64_t{160} << 20;
    const std::uint64_t needed = points * (kind_ ? kTopology : kMesh) + (picture_.path().empty() ? 0 : kPicture);
    const std::optional<std::uint64_t> given = memory_.bytes();
    if (!given || needed <= *given) return;
    const std::uint64_t megabytes = (needed >> 20) + 1;
    throw InputError(
        fmt::format("--memory: the triangulation of this window, of about {}, takes some {}M; give as much, "
                    "a smaller window, or a coarser --tolerance",
                    counted(points, "point"), megabytes));
  }

  static std::string theme_names(const StoreMetadata& metadata) {
    if (metadata.themes.empty()) return "none";
    return fmt::format("{}", fmt::join(ThemeChoice::all().names(metadata.themes), ", "));
  }

  /// The numbers of the themes whose lines are asked for.
  std::vector<std::uint16_t> line_themes(const StoreMetadata& metadata, const ThemeChoice& themes) const {
    std::vector<std::uint16_t> numbers;
    for (const std::string& name : lines_) {
      const auto theme = std::find_if(metadata.themes.begin(), metadata.themes.end(),
                                      [&](const ThemeInfo& t) { return t.name == name; });
      if (theme == metadata.themes.end())
        throw InputError(fmt::format("--lines: the store has no theme '{}'; it has {}", name, theme_names(metadata)));
      if (!themes.includes(*theme)) throw InputError(fmt::format("--lines: --themes leaves out '{}'", name));
      numbers.push_back(static_cast<std::uint16_t>(theme - metadata.themes.begin() + 1));
    }
    return numbers;
  }

  /// A message about the theme lines_[i], of which no line was written.
  std::string no_lines(const WindowLines& lines, std::size_t i) const {
    const bool is_there = std::any_of(lines.tin.lines.begin(), lines.tin.lines.end(),
                                      [&](const LineEdge& e) { return e.theme == lines.themes[i]; });
    return fmt::format("--lines: the theme '{}' {}", lines_[i],
                       is_there
                           ? "has no lines: what stands by the cells of a raster has no outlines; leave out --lines "
                             "to have its triangles"
                           : "has no line in this window");
  }

  void write(const Store& store, const WindowLines& lines, const Document& surface, Progress& progress,
             std::vector<std::string>& warnings) {
    Document command{{"verb", name()}};
    command.update(query());
    Document about{{"command", command}, {"surface", surface}};
    if (kind_) about["statistics"] = statistics_document(lines.tin.statistics, lines.tin.triangles.size());
    const TinExportOptions options = tin_export_options(store.metadata(), about, policy_.overwrite);
    if (!lines.themes.empty()) {
      const std::vector<std::size_t> counts = export_lines(store, lines, output_, options, progress);
      joined_ = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
      for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] == 0) warnings.push_back(no_lines(lines, i));
    } else if (kind_) {
      export_topology(lines.tin, *kind_, output_, options, progress);
    } else {
      export_tin(lines.tin, output_, options, progress);
    }
  }

  Document document(const Tin& tin, const StoreMetadata& metadata, const Document& surface) const {
    Document document;
    document["crs"] = crs_identifier(metadata.crs_wkt);
    document["surface"] = surface;
    if (!tin.vertices.empty()) document["bounds"] = box_document(tin.bounds());
    document["vertices"] = tin.vertices.size();
    document["triangles"] = tin.triangles.size();
    document["line_edges"] = tin.lines.size();
    if (joined_) document["lines"] = *joined_;
    document["outputs"] = outputs();
    document["statistics"] = statistics_document(tin.statistics, tin.triangles.size());
    return document;
  }

  std::string text(const Tin& tin) const {
    std::string text;
    for (const std::string& path : outputs()) {
      if (joined_ && path == output_) {
        text += fmt::format("{}: {}, {}\n", path, counted(*joined_, "line"),
                            readable_bytes(std::filesystem::file_size(path)));
        continue;
      }
      text += fmt::format("{}: {}, {}, {}\n", path, counted(tin.vertices.size(), "vertex", "vertices"),
                          counted(tin.triangles.size(), "triangle"), readable_bytes(std::filesystem::file_size(path)));
    }
    return text + read_in_words(tin.statistics);
  }

  std::vector<std::string> outputs() const {
    std::vector<std::string> paths;
    for (const std::string& path : {output_, picture_.path()})
      if (!path.empty()) paths.push_back(path);
    return paths;
  }

  std::string store_, output_, topology_;
  std::vector<std::string> lines_;
  std::optional<std::size_t> joined_;  ///< lines written
  std::optional<TopologyKind> kind_;
  SurfaceRaster surface_;
  PictureOptions picture_;
  WindowOptions window_;
  DetailOptions detail_;
  ThemeOptions themes_;
  MemoryOption memory_;
  OutputPolicy policy_;
};

}  // namespace

std::unique_ptr<Verb> make_tin_verb() {
  return std::make_unique<TinVerb>();
}

}  // namespace itin::cli
