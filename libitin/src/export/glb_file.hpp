// What every .glb file has: its header, the views of its one buffer, and what its coordinates are about.
//
//   GlbLayout layout;
//   const std::size_t positions = layout.add(n, 12, gltf::kArrayBuffer);
//   begin_glb(file, document, layout.bytes());                   // then come the bytes of the views, in their order
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include <itin/geometry.hpp>

#include "export/buffered_file.hpp"

namespace itin {

/// Numbers as the specification of glTF 2.0 has them.
namespace gltf {
inline constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
}  // namespace gltf

using GltfVector = std::array<float, 3>;

/// Turns east, north, up into glTF's axes: y up, right-handed.
inline GltfVector gltf_axes(double east, double north, double up) {
  return {static_cast<float>(east), static_cast<float>(up), static_cast<float>(-north)};
}

/// The places of the buffer views in the file's one buffer, in the order in which they are written.
class GlbLayout {
 public:
  /// Adds a view and returns its number. Its stride is `element_bytes`, which indices must not state.
  std::size_t add(std::size_t count, std::size_t element_bytes, int target);
  std::size_t bytes() const { return bytes_; }
  const nlohmann::ordered_json& views() const { return views_; }

 private:
  std::size_t bytes_ = 0;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
};

/// Returns a document that has no scene yet.
nlohmann::ordered_json begun_glb();

/// Returns a scene that says besides its `extras` what coordinates are about, and has nothing in it yet.
nlohmann::ordered_json empty_glb_scene(nlohmann::ordered_json extras, const Point3& origin, const std::string& crs_wkt);

/// Writes everything before the buffer, which has so many bytes. Throws InputError for more than 4 GB, FileError.
void begin_glb(BufferedFile& file, const nlohmann::ordered_json& document, std::size_t buffer_bytes);

}  // namespace itin
