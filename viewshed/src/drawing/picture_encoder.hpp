// What pictures need of OpenImageIO to become files, loaded when the first is written. It brings some 150 libraries
// with it, which would cost every command a tenth of a second.
//
//   picture_encoder().encode(picture, "map.png", 98, &bytes, append);
//
// The module (viewshed/drawing) knows nothing of itin except this header; plain types alone pass between the two.
#pragma once

#include <cstddef>
#include <cstdint>

namespace itin::viewshed {

/// 8-bit samples, row by row from the top: one per pixel is grey, three are red, green and blue, the fourth is alpha.
struct Picture {
  std::uint8_t* samples;
  int width, height, channels;
};

using Append = void (*)(void* to, const void* bytes, std::size_t count);

struct PictureEncoder {
  /// Tells whether the path's ending names a format.
  bool (*knows_format)(const char* path);
  /// Passes on a file's bytes, in the format that the path's ending names; `quality` is that of a JPEG, 1 to 100.
  /// Returns null, or why it failed, which is valid until the thread's next call.
  const char* (*encode)(const Picture& picture, const char* path, int quality, void* to, Append append);
};

/// Loads the module, and returns the table that it exports as `itin_picture_encoder`. Throws FileError where it is
/// missing or broken.
const PictureEncoder& picture_encoder();

}  // namespace itin::viewshed
