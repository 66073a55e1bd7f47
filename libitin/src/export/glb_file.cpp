#include "export/glb_file.hpp"

#include <limits>
#include <utility>

#include <itin/error.hpp>

#include "export/export_metadata.hpp"

namespace itin {

std::size_t GlbLayout::add(std::size_t count, std::size_t element_bytes, int target) {
  nlohmann::ordered_json view = {
      {"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", count * element_bytes}, {"target", target}};
  if (target == gltf::kArrayBuffer) view["byteStride"] = element_bytes;
  views_.push_back(std::move(view));
  bytes_ += count * element_bytes;  // all elements are multiples of four bytes, as the format demands of offsets
  return views_.size() - 1;
}

nlohmann::ordered_json begun_glb() {
  return {{"asset", {{"version", "2.0"}, {"generator", std::string("itin ") + ITIN_VERSION}}}, {"scene", 0}};
}

nlohmann::ordered_json empty_glb_scene(nlohmann::ordered_json extras, const Point3& origin,
                                       const std::string& crs_wkt) {
  extras["origin"] = {origin.x, origin.y, origin.z};
  extras["axes"] = "x east, y up, z south; metres about origin (easting, northing, up)";
  extras["crs"] = crs_wkt;
  return {{"extras", std::move(extras)}};
}

void begin_glb(BufferedFile& file, const nlohmann::ordered_json& document, std::size_t buffer_bytes) {
  std::string json = dumped(document);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t total = 12 + 8 + json.size() + (buffer_bytes > 0 ? 8 + buffer_bytes : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw InputError("export: glTF files end at 4 GB; choose a coarser tolerance, a smaller window or .ply");
  file.write("glTF");
  file.little_endian(std::uint32_t{2});
  file.little_endian(static_cast<std::uint32_t>(total));
  file.little_endian(static_cast<std::uint32_t>(json.size()));
  file.write("JSON");
  file.write(json);
  if (buffer_bytes == 0) return;
  file.little_endian(static_cast<std::uint32_t>(buffer_bytes));
  file.write(std::string_view("BIN\0", 4));
}

}  // namespace itin
