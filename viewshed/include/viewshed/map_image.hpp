// Pictures for reports: a map of a viewshed over hillshade, with observers, and beside it title, legend, scale bar,
// north and sources; and a surface seen from afar and above, or from a place.
//
//   const Tin tin = triangulate(store, Window::all(), request.detail, progress);
//   const viewshed::Result result = viewshed::compute(tin, request, progress);
//   viewshed::write_image("map.png", viewshed::draw_map(tin, result, {.title = "Mast at Caerphilly"}), false);
//   viewshed::write_image("hills.png", viewshed::draw_oblique(tin, {.azimuth = 340, .elevation = 40}), false);
//   viewshed::write_image("view.png", viewshed::draw_perspective(tin, {.eye = {318000, 176000, 52}}), false);
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <itin/progress.hpp>
#include <itin/tin.hpp>
#include <profile/links.hpp>
#include <profile/los.hpp>
#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// Shares of `of` that fall to the classes of a legend, percent.
struct ClassShares {
  std::string of = {};  ///< "the demand"
  double seen = 0, unseen = 0, undecided = 0;
};

struct MapOptions {
  std::string title = "Viewshed";
  std::string subtitle = {};                        ///< empty: observer and target heights, radius, refraction
  std::string seen = "Visible", unseen = "Hidden";  ///< in the legend, where cells are one of the two
  std::optional<ClassShares> shares = {};           ///< in the legend; nothing: shares of the cells with data in view
  std::string observers = {};                       ///< what the legend calls them; empty: "Observers"
  std::string counts = "Number of observers that see the place";  ///< heads the scale of Mode::kCount
  std::string outside = "Outside the field of view, or no data";
  std::vector<std::uint8_t> no_data = {};  ///< one per cell: 1 to stripe it as without ground; empty: none
  std::string no_data_text = "No ground data";
  std::string beyond_text = {};  ///< what lies beyond the ground data; empty: nothing is said
  std::string statement = {};    ///< what the surface takes into account; empty: the subtitle takes its place
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< what else is said: name, value
  std::vector<std::string> sources = {};                        ///< where the data comes from
  std::string crs_wkt = {};  ///< the CRS whose grid is marked; the National Grid is marked by its letters
  int map_pixels = 1600;     ///< the longer side of the map proper, 200 to 16000
};

/// 8-bit sRGB, row by row from the north-west.
struct MapImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Draws a map of a viewshed; `result` must come from `tin`. Colours can be told apart by colour-blind readers and in
/// grey print. Throws InputError for a size out of range, Error when drawing fails.
MapImage draw_map(const Tin& tin, const Result& result, const MapOptions& options = {});
/// Draws the map over the surface that compute_with_surface() kept, and reads the heights of it that have not been
/// read.
MapImage draw_map(RetrievedSurface& surface, const Result& result, Progress& progress, const MapOptions& options = {});

/// Options of draw_oblique(), a shaded parallel projection. What stands on the surface has a colour for each kind of
/// theme.
struct ObliqueOptions {
  double azimuth = 340;               ///< degrees clockwise from grid north: where the viewer looks
  double elevation = 40;              ///< degrees, above 0 up to 90: how high above the horizon the viewer is
  int pixels = 1600;                  ///< the picture's longer side, 200 to 16000
  bool edges = false;                 ///< draws the edges of all triangles, over the shading
  std::vector<ThemeKind> kinds = {};  ///< one for each theme of the store, in order; without them all tops are grey
};

/// Draws a surface from afar and above. Hidden parts are hidden exactly, up to a pixel. O(n) time for n triangles and
/// O(pixels^2) memory, on one thread. Throws InputError for options out of range and for a surface without triangles.
MapImage draw_oblique(const Tin& tin, const ObliqueOptions& options = {});

/// Options of draw_perspective(): what an eye sees of a surface over the curved Earth, in the colours of
/// draw_oblique().
struct PerspectiveOptions {
  Point3 eye = {};     ///< its z an elevation, metres
  double azimuth = 0;  ///< degrees clockwise from grid north, in the middle of the picture
  double pitch = 0;    ///< degrees above the horizontal, between -90 and 90
  double field = 60;   ///< degrees across the picture, 1 to 150
  int pixels = 1600;   ///< the picture's width, 200 to 16000; its height is nine sixteenths of that
  Earth earth = {};
  bool edges = false;                 ///< draws the edges of all triangles, over the shading
  std::vector<ThemeKind> kinds = {};  ///< as ObliqueOptions::kinds
};

/// Draws what an eye sees. Cost and errors are those of draw_oblique(). Nothing nearer than 0.1 m is drawn.
MapImage draw_perspective(const Tin& tin, const PerspectiveOptions& options);

/// What a map of one line shows besides the line.
struct LocationOptions {
  std::span<const profile::Link> others = {};  ///< neighbours, in grey; the line itself may be among them
  ThemeChoice themes = ThemeChoice::none();    ///< those of the line's surface: outlines of its buildings are drawn
};

/// Draws where a line over a store runs, over the relief of its surroundings, for profile::LosReport::location. Throws
/// CorruptStore, Cancelled.
std::shared_ptr<const profile::MapSheet> location_map(const Store& store, const profile::LosReport& report,
                                                      const LocationOptions& options, Progress& progress);

/// Draws all links of a survey, in colours by verdict, for profile::LinkFileOptions::map; null where none could be
/// computed. `title` is that of the page. Throws CorruptStore, Cancelled.
std::shared_ptr<const profile::MapSheet> links_map(const Store& store, const profile::LinkSurvey& survey,
                                                   const std::string& title, Progress& progress);

/// Throws InputError if OpenImageIO knows no format for the path's ending (png, jpg, tif, ...).
void require_image_format(const std::string& path);

/// Writes a picture to a file, which appears only when complete. Throws what require_image_format() throws, and
/// FileError if the place cannot be written, or if the file exists and `overwrite` is false.
void write_image(const std::string& path, const MapImage& image, bool overwrite);

}  // namespace itin::viewshed
