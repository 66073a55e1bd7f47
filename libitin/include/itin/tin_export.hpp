// Writes a Tin to the formats that others read.
//
//   TinExportOptions options;
//   options.crs_wkt = store.metadata().crs_wkt;
//   export_tin(tin, "hills.ply", options, progress);
//
// The file name's ending chooses the format. Vertices and triangles keep their order in every format but .glb, where
// the triangles of the ground come first and then those of each theme that stands on it. Where themes stand on the
// ground, triangles say which theme they are part of: `ushort theme` in .ply (0 is ground), groups in .obj, a material
// and a colour per theme in .glb, a property `theme` in .gpkg and .geojson, null on the ground, a material in .2dm.
//
// .ply      binary, little-endian. Vertex properties: double x y z; uint id_high id_low, where the VertexId is
//           id_high * 2^32 + id_low; ushort source. Faces: vertex_indices. Where there are lines, edges: int vertex1
//           vertex2; ushort theme, whose name is in a comment `theme NUMBER NAME`. The CRS is a comment.
// .obj      text; positions as the shortest decimals that read back as the same doubles. No ids: it has no place for
//           them. The CRS is a comment.
// .glb      glTF 2.0, for viewing: y up, x east, z south. Single-precision positions about a local origin, wrong by at
//           most 2^-23 of the extent; the origin (easting, northing, up, exact) and the CRS are in the scene's extras.
//           Normals, colours by height; _VERTEX_ID as four 16-bit words, least first; _SOURCE.
// .gpkg     layers `triangles` (polygons with z; vertex_a/b/c, source_a/b/c), `vertices` (points with z; id and
//           source) and, where there are lines, `lines` (edges with z; vertex_a/b, theme by name). Only the first has
//           a spatial index, which is what takes the time: 12 s per million triangles. Timestamps are fixed, so that
//           equal Tins give equal files.
// .geojson  polygons with z in the store's CRS, named in the `crs` member of GeoJSON 2008, which GDAL and QGIS follow;
//           the same properties; then, where there are lines, their edges with properties as in .gpkg. Ids are
//           integers beyond 2^53: read them with 64 bits.
// .2dm      text, a mesh layer for QGIS: nodes and triangles, each numbered from 1 in their order. The material of a
//           triangle is 1 for ground, otherwise 1 plus the number of its theme. No ids and no CRS: it has no place for
//           them.
//
// Coordinates are exact but for .glb: they quantise to the same grid positions as the Tin's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <itin/detail.hpp>
#include <itin/progress.hpp>
#include <itin/tin.hpp>
#include <itin/window.hpp>

namespace itin {

class Store;

struct TinExportOptions {
  std::vector<std::string> theme_names = {};  ///< names for Tin::lines: theme t is theme_names[t - 1]
  std::string crs_wkt = {};                   ///< the CRS of the coordinates; empty: unknown
  bool overwrite = false;                     ///< replace an existing file
  std::string metadata_json = {};  ///< a JSON object that says where the Tin comes from, or nothing. Kept by .glb
                                   ///< (extras), .gpkg (metadata item METADATA_JSON), .geojson (`metadata`); its
                                   ///< members open a topology document.
};

/// The three structures of topology.hpp.
enum class TopologyKind { TriangleBased, VertexBased, EdgeBased };

/// Reads "triangle", "vertex" or "edge". Throws InputError.
TopologyKind topology_kind(std::string_view name);

/// Throws what export_tin() or export_topology() would throw before writing: InputError for an unknown ending,
/// FileError for an existing file without overwrite or a missing folder. Worth calling before a long query.
void require_tin_output(const std::string& path, bool overwrite);
void require_topology_output(const std::string& path, bool overwrite);

/// Writes the Tin under a temporary name beside `path` and renames when complete; whatever is thrown, `path` stays as
/// it was. Throws InputError (unknown ending; metadata that is not an object; a CRS without an EPSG code for .geojson;
/// too many vertices for .glb), FileError, Cancelled. O(n) time and, but for .glb (24 bytes per vertex), constant
/// memory.
void export_tin(const Tin& tin, const std::string& path, const TinExportOptions& options, Progress& progress);

/// Writes a JSON document (path ends in .json): `topology` (the kind), `crs` (WKT), `vertex_ids` (decimal strings, for
/// many readers lose digits beyond 2^53), `sources`, `vertices` [[x, y, z]], where there are lines `lines` [[a, b,
/// theme by name]], and
///   triangle: `triangles` [[a, b, c]], `adjacent_triangles` [[across ab, across bc, across ca]], null at the boundary
///   vertex:   `neighbours` [[...]] counterclockwise, a boundary vertex's from the boundary on; `boundary` [bool]
///   edge:     `half_edges` [[origin, twin, next, face]], twin null at the boundary
/// Indices count from 0. Throws as export_tin() does.
void export_topology(const Tin& tin, TopologyKind kind, const std::string& path, const TinExportOptions& options,
                     Progress& progress);

/// The lines to write: those of the themes (from 1) in a window.
struct WindowLines {
  const Tin& tin;  ///< triangulate() of the window at the detail, with these themes
  const Window& window;
  const Detail& detail;
  std::vector<std::uint16_t> themes;
};

/// Writes lines with z as a GeoPackage (.gpkg), layer `lines`, or GeoJSON (.geojson) in the store's CRS. At a tolerance
/// the lines of the terrain are generalised to it. The columns are the theme, `feature_id`, `feature_name`, the
/// attributes that the import kept, and `length_m`, the horizontal length. Returns how many lines each theme has.
/// Throws as export_tin() does, and CorruptStore.
///
/// Lines on the ground are written as all edges of the surface that meet the window, whatever the window, feature by
/// feature and as far as they go on: a line ends at the window, and where the number of its feature's edges that meet
/// is not two. Features that stand are written as the sides, as imported, of the footprints that have a part of the
/// surface, at the height of the terrain under them. Measured roofs without footprints have the outlines of their
/// surfaces together; rasters of heights have no lines.
std::vector<std::size_t> export_lines(const Store& store, const WindowLines& lines, const std::string& path,
                                      const TinExportOptions& options, Progress& progress);
/// Throws what export_lines() would throw before writing.
void require_lines_output(const std::string& path, bool overwrite);

}  // namespace itin
