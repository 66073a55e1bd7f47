// Pictures in memory as the bytes of files, for what is embedded in pages.
//
//   const std::string jpeg = picture_bytes({greys, 1000, 800, 1}, "ground.jpg", 80);
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace itin::viewshed {

/// Samples of 8 bits, row by row from the north-west. One per pixel is grey; three are red, green and blue; a fourth is
/// alpha, and the colours are not multiplied by it.
struct PictureSamples {
  std::span<const std::uint8_t> values;
  int width = 0, height = 0, channels = 3;
};

/// Returns the bytes of a file of the format that the path's ending names; `quality` is that of a JPEG, 1 to 100.
/// Throws FileError.
std::string picture_bytes(const PictureSamples& picture, const std::string& path, int quality = 98);

}  // namespace itin::viewshed
