// Import of terrain, from rasters, point files, LAS and LAZ to a store with its Delaunay pyramid, and of lines.
//
//   ImportOptions options;
//   options.sources = {"ST17.asc", "ST18.asc"};
//   const ImportReport report = import_terrain("cardiff.itin", options, progress);
//   for (const std::string& warning : report.warnings) std::cerr << warning << '\n';
//
// Importing into an existing store adds to it. Vertices, triangles, levels and certificates (of terrain, lines and
// standing features) depend on the set of sources and their options alone, whatever the order and the portions in which
// they were imported: a store keeps unchanged what it leaves out, cuts or moves, and every import begins with all of
// it. The order shows in what the first import chooses for a store, CRS, grid and levels, and nowhere else.
//
// Where no line lies on the ground (contours, breaklines, water, roads, outlines without heights), features that stand
// come and go, and the ground stays as it is. In all other cases adding makes the whole store again; it takes as long
// as importing everything anew.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/progress.hpp>
#include <itin/store.hpp>

namespace itin {

/// Where the outline of a building lies: on the terrain, down to which its walls reach; or level at its base, and then
/// the ground about it is cut away or filled up.
enum class Foundation { walls, flat };

struct ImportOptions {
  std::vector<std::string> sources = {};  ///< anything GDAL opens as a raster or a point layer, .las, .csv, .xyz, .txt

  // These options change the answer.
  std::optional<ThemeKind> kind = {};  ///< the kind of lines, for import_lines(); nothing: terrain points
  std::string theme = {};              ///< the name of the lines' theme
  std::string crs = {};                ///< the CRS of sources that do not name one; overrides those that do
  std::string to_crs = {};  ///< the store's; default: the source's own if metric and projected, else a UTM zone
  std::string z_field =
      {};  ///< the height attribute of point layers and CSV; default: Z of the geometry, or the third column
  std::string layer = {};
  std::string where = {};
  /// What the store keeps of the features of lines, footprints and CityJSON, for exports and reports.
  std::string id_field = {};    ///< default: the source's number or key for the feature
  std::string name_field = {};  ///< also the name of a raised feature in messages; default: none
  std::optional<std::vector<std::string>> attributes =
      {};                        ///< fields; default: all with numbers, texts, dates and times
  std::optional<int> band = {};  ///< the band of rasters that holds heights, from 1; default: their only one

  // These are for raised features only: CityJSON, and buildings, vegetation and walls for which one of the first four
  // is given.
  std::string height_field = {};      ///< height of the highest point above the base
  std::string eaves_field = {};       ///< height of the eaves above the base
  std::string height_from = {};       ///< a raster of elevations (DSM) in the store's CRS, over the terrain: gives
                                      ///< heights to features that have none in the fields
  std::optional<double> height = {};  ///< metres; for features that have none in the fields and in height_from
  /// Which of the cells of height_from within a footprint gives its height, 0 to 100; default: 50, their median.
  std::optional<double> height_percentile = {};
  std::string base_field = {};        ///< elevation of the base
  std::optional<BaseRule> base = {};  ///< for buildings without base_field; default: minimum, or the floors of CityJSON
  std::optional<RoofKind> roof = {};  ///< default: flat
  /// How buildings meet the terrain; default: walls down to it.
  std::optional<Foundation> foundation = {};
  std::optional<double> storey = {};     ///< metres; height_field and eaves_field count storeys of this height
  std::optional<double> thickness = {};  ///< metres, of features that stand on lines; default: 0.3
  /// How far within its outline a feature's walls reach their full height: metres, from two grid steps to 10. There is
  /// one value for all features of a theme. Default: the theme's own; for a new theme 0.05 or two grid steps.
  std::optional<double> wall_offset = {};

  // These are for rasters of standing heights only: heights above the ground (of buildings and vegetation), and
  // elevations of a surface.
  std::optional<double> height_step = {};  ///< metres, whole millimetres: cells stand in multiples of it; default: 2
  std::optional<double> height_threshold = {};  ///< metres above the ground: lower cells do not stand; default: 2
  std::optional<HeightRounding> height_rounding = {};  ///< default: nearest

  std::vector<int> classes = {};      ///< LAS classes to keep; empty: all but noise (7, 18)
  double max_gap = 0;                 ///< metres, scattered points: ground is not triangulated over longer edges;
                                      ///< 0: 100 times the mean spacing of the source
  bool allow_mixed_vertical = false;  ///< take heights as they are, though they refer to different vertical datums
  std::string source_note = {};       ///< product, date and licence of the sources, for reports; default: the
                                      ///< copyright that a raster states
  bool repair = true;                 ///< import_lines() of contours: infer points where their triangles are flat
  /// For rasters: missing ground within the box about them, voids included, becomes level ground at this elevation (the
  /// sea), metres, on their datum. Real terrain replaces it, whenever that is imported. Nothing: the ground stays
  /// missing.
  std::optional<double> sea_level = {};
  std::string sea_area = {};  ///< polygons, as text or a file: the sea fills missing ground within all of them, and
                              ///< nowhere else
  bool replace = false;       ///< these sources take the place of others that are no finer in their coverage
  /// Features to take out before the sources are added: names of themes whose features stand, or of files among the
  /// sources of such themes. The store is then as if they had never been imported. With it there may be no sources.
  std::vector<std::string> remove = {};
  bool stay = false;  ///< import_lines() of contours, breaklines and water: they stay within the coverage of
                      ///< sources that replace others
  std::vector<double> tolerances = {};  ///< metres; default: those of 0.5,1,2,4,8,16,32 that are no less than the
                                        ///< resolution. An existing store keeps its own.
  double resolution = 0.01;             ///< metres; an existing store keeps its own

  // These options change the speed only.
  std::uint64_t memory_bytes = std::uint64_t{4} << 30;
};

struct ImportReport {
  std::string crs_name;             ///< the store's CRS
  bool crs_chosen = false;          ///< a UTM zone was chosen, because the source is not metric
  std::uint64_t read = 0;           ///< posts, points and vertices read with a height
  std::uint64_t read_features = 0;  ///< lines, polygons and other features that had these vertices
  std::uint64_t voids = 0;          ///< posts without data
  std::uint64_t filtered = 0;       ///< points and features left out by class or where
  std::uint64_t duplicates = 0;     ///< points at the place of another
  std::uint64_t replaced = 0;       ///< points that make room for others since this import
  std::uint64_t made_room = 0;      ///< pieces of lines, of all imports so far, that make room for ground that replaces
                                    ///< others, wholly or in part; counted where such lines or ground are imported
  std::uint64_t isolated = 0;       ///< points left out in this import because no ground could be triangulated about
                                    ///< them
  std::uint64_t features = 0;       ///< line features read, or features that stand now
  std::uint64_t removed = 0;        ///< features taken out, whether they stood or not
  std::uint64_t refused = 0;        ///< features that could not stand, of all imports so far; warnings say why
  std::uint64_t cells = 0;          ///< cells with a height in rasters of heights that stand
  std::uint64_t low_cells = 0;      ///< cells among them that are known not to reach the threshold
  double height_error_low = 0;      ///< metres: by how much cells stand lower than their rasters say, at most,
  double height_error_high = 0;     ///< or higher, besides the rounding to millimetres and the store's grid
  std::uint64_t crossings = 0;      ///< further pairs of segments that cross, of any themes, and were given a vertex
  std::uint64_t left_out = 0;       ///< further segments, of any theme, that do not lie wholly on the ground
  std::uint64_t flat_before = 0;    ///< triangles that are level because their corners lie on contours
  std::uint64_t flat_after = 0;     ///< how many of flat_before are left
  std::uint64_t inferred = 0;       ///< points of the store inferred from contours
  std::uint64_t vertices = 0;       ///< how many the store has now
  std::uint64_t sea = 0;            ///< vertices of the sea among them
  std::uint64_t store_bytes = 0;
  double seconds = 0;
  /// Why the ground of a store that was there was made again; empty where the ground stayed as it was, and for a new
  /// store.
  std::string ground_made_again;
  std::vector<LevelInfo> levels;
  std::vector<std::string> warnings;  ///< one line each
};

/// Imports terrain. Throws InputError (also for an option that none of the sources makes use of), FileError,
/// StoreFormatError, CorruptStore, Cancelled. Whatever is thrown, the store stays as it was.
ImportReport import_terrain(const std::string& store_path, const ImportOptions& options, Progress& progress);

/// Adds lines and polygons (as their rings) to a theme, which is made if there is none of that name. Contours may make
/// a new store; other lines need ground to lie on. All lines of the store are made planar together: crossings get a
/// vertex, and no line moves by more than half a grid step. Heights of lines of the terrain win over heights of points;
/// where lines meet, lines of the terrain decide first, and then the first name in order. Lines of other kinds take the
/// heights of the full surface at their vertices. Throws as import_terrain() does.
///
/// Where contours are imported, options.repair decides for all contours of the store, also when something is added
/// later; where several imports of contours differ in it, contours are not repaired. A repair infers points along
/// ridges, valleys, passes, hilltops and pits (Ware 1998). They have a source of their own, the last one, of kind
/// "inferred". They depend on the imported terrain and lines alone, and are inferred anew whenever terrain or lines are
/// added.
///
/// Buildings, vegetation and walls with heights stand on the ground (builds_features()): queries that choose their
/// theme see roofs and tops, in place of what lies under them. They need ground all under them; others are refused,
/// with a warning. At full detail they only raise the surface: outside of footprints it stays as it is, and within them
/// it is nowhere lower, but for rounding to the grid. Buildings on flat foundations bend the ground about them as well,
/// within its triangles that an outline crosses. The store keeps their footprints, and stands them up again whenever
/// its terrain changes.
///
/// Rasters stand as well. They have heights above the ground (canopies, buildings), or show a surface, whose heights
/// above the ground are its elevations less the terrain's under the middles of cells. A cell stands as high above the
/// terrain as its height says, in whole steps, and not at all below the threshold. Connected cells of equal height are
/// one feature. The store keeps the heights of the cells, and makes the features anew as its terrain changes. The
/// raster must be in the CRS of the store. Cells that reach beyond the ground are left out, with a warning.
ImportReport import_lines(const std::string& store_path, const ImportOptions& options, Progress& progress);

/// Tells whether features that import_lines() imports with these options stand on the ground.
bool builds_features(const ImportOptions& options);

}  // namespace itin
