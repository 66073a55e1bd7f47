// What maps need of OpenImageIO, loaded when the first map is drawn. It brings some 150 libraries with it, which would
// cost every command a tenth of a second.
//
//   drawing().draw_text(...);
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

/// A font's path and its height in pixels.
struct Font {
  const char* path;
  int size;
};

using Append = void (*)(void* to, const void* bytes, std::size_t count);

struct Drawing {
  /// Draws text from (x, y), or about it, or up to it, for align 0, 1, 2; on three channels.
  void (*draw_text)(const Picture& picture, const char* text, const Font& font, int x, int y, int align,
                    const float* colour);
  int (*text_width)(const char* text, const Font& font);
  /// Tells whether the path's ending names a format.
  bool (*knows_format)(const char* path);
  /// Passes on a file's bytes, in the format that the path's ending names; `quality` is that of a JPEG, 1 to 100.
  /// Returns null, or why it failed, which is valid until the thread's next call.
  const char* (*encode)(const Picture& picture, const char* path, int quality, void* to, Append append);
};

/// Loads the module, and returns the table that it exports as `itin_drawing`. Throws FileError where it is missing or
/// broken.
const Drawing& drawing();

}  // namespace itin::viewshed
