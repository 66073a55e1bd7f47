// Files of pictures.
#include <filesystem>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/picture_bytes.hpp>

#include "drawing/picture_encoder.hpp"

namespace itin::viewshed {

void require_image_format(const std::string& path) {
  if (!picture_encoder().knows_format(path.c_str()))
    throw InputError(fmt::format("{}: no image format for the ending '{}'; use .png or .jpg", path,
                                 std::filesystem::path(path).extension().string()));
}

std::string picture_bytes(const PictureSamples& samples, const std::string& path, int quality) {
  // The module does not change what it encodes.
  const Picture picture{const_cast<std::uint8_t*>(samples.values.data()), samples.width, samples.height,
                        samples.channels};
  std::string bytes;
  const char* const failed = picture_encoder().encode(
      picture, path.c_str(), quality, &bytes, [](void* to, const void* from, std::size_t count) {
        static_cast<std::string*>(to)->assign(static_cast<const char*>(from), count);
      });
  if (failed != nullptr) throw FileError(path, std::string("cannot be written: ") + failed);
  return bytes;
}

void write_image(const std::string& path, const MapImage& image, bool overwrite) {
  require_image_format(path);
  write_file(path, picture_bytes({image.rgb, image.width, image.height, 3}, path), overwrite);
}

}  // namespace itin::viewshed
