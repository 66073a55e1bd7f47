// Meshes of flat colours as glTF, for viewing.
//
//   ColouredMesh wall{"served", {0, 114, 178}, {}};
//   wall.triangles.push_back({Point3{x, y, 0}, Point3{x + 1, y, 0}, Point3{x + 1, y, 3}});   // faces south
//   write_meshes("facades.glb", store.metadata().crs_wkt, {wall}, false, progress);
#pragma once

#include <array>
#include <string>
#include <vector>

#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/raster.hpp>

namespace itin {

struct ColouredMesh {
  std::string name;
  Rgba colour;  ///< sRGB
  /// Easting, northing, up; counterclockwise as seen from the front, which alone is drawn.
  std::vector<std::array<Point3, 3>> triangles;
};

/// Writes glTF 2.0 (.glb), a node for each mesh that has a triangle: y up, x east, z south, in single precision about
/// a local origin that the scene's extras tell, with the CRS. Triangles are flat. Equal calls write equal bytes. Throws
/// FileError if the file exists and may not be replaced, or cannot be written; InputError beyond 4 GB; Cancelled.
void write_meshes(const std::string& path, const std::string& crs_wkt, const std::vector<ColouredMesh>& meshes,
                  bool overwrite, Progress& progress);

}  // namespace itin
