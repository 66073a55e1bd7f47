// Pictures in memory as the bytes of files, for what is embedded in pages.
//
//   const std::string jpeg = picture_bytes({greys, 1000, 800, 1}, "ground.jpg", 80);
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace itin::viewshed {

/// 8 bits each, row by row from the north-west: one per pixel is grey, three are red, green and blue, the fourth is
/// alpha, which the colours are not multiplied by.
struct PictureSamples {
  std::span<const std::uint8_t> values;
  int width = 0, height = 0, channels = 3;
};

/// The bytes of a file of the format that the path's ending names; `quality` is that of a JPEG, 1 to 100. Throws
/// FileError.
std::string picture_bytes(const PictureSamples& picture, const std::string& path, int quality = 98);

}  // namespace itin::viewshed
