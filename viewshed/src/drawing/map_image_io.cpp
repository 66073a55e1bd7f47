// Lettering and files of maps.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <viewshed/map_image.hpp>
#include <viewshed/picture_bytes.hpp>

#include "drawing/drawing.hpp"
#include "drawing/lettering.hpp"
#include "drawing/plain_text.hpp"

namespace itin::viewshed {

namespace {

namespace fs = std::filesystem;

std::string find_font() {
  std::vector<fs::path> places{"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "/System/Library/Fonts"};
  if (const char* home = std::getenv("HOME")) places.push_back(fs::path(home) / ".local/share/fonts");
  // Earlier names are preferred: metrics differ little, but a machine should always choose the same font.
  constexpr std::array kNames{"DejaVuSans.ttf", "LiberationSans-Regular.ttf", "NotoSans-Regular.ttf", "FreeSans.ttf",
                              "Arial.ttf"};
  std::array<std::string, kNames.size()> found;
  for (const fs::path& place : places) {
    std::error_code error;
    for (fs::recursive_directory_iterator i(place, fs::directory_options::skip_permission_denied, error), end;
         !error && i != end; i.increment(error)) {
      const auto name = std::find(kNames.begin(), kNames.end(), i->path().filename());
      if (name == kNames.end()) continue;
      std::string& slot = found[static_cast<std::size_t>(name - kNames.begin())];
      if (slot.empty()) slot = i->path().string();
    }
  }
  const auto best = std::find_if(found.begin(), found.end(), [](const std::string& path) { return !path.empty(); });
  return best == found.end() ? std::string() : *best;
}

constexpr double kRaised = 0.32;  ///< in sizes of letters

int size_of(const PlainPiece& piece, int size) {
  return piece.raised ? std::max(6, size * 13 / 20) : size;
}

}  // namespace

Lettering::Lettering() : font_(find_font()) {}

void Lettering::draw(Canvas& canvas, const std::string& text, Point2 baseline, int size, Rgba colour,
                     Align align) const {
  if (!available()) return;
  const std::array<float, 3> rgb{colour.red / 255.0F, colour.green / 255.0F, colour.blue / 255.0F};
  const auto put = [&](const PlainPiece& piece, double x, Align about) {
    const int side = about == Align::kLeft ? 0 : about == Align::kCentre ? 1 : 2;
    drawing().draw_text({canvas.rgb().data(), canvas.width(), canvas.height(), 3}, piece.text.c_str(),
                        {font_.c_str(), size_of(piece, size)}, static_cast<int>(x),
                        static_cast<int>(baseline.y - (piece.raised ? kRaised * size : 0)), side, rgb.data());
  };
  const std::vector<PlainPiece> pieces = plain_pieces(text);
  if (pieces.size() == 1) return put(pieces.front(), baseline.x, align);
  double x = baseline.x - (align == Align::kLeft ? 0 : align == Align::kCentre ? 0.5 : 1) * width(text, size);
  for (const PlainPiece& piece : pieces) {
    put(piece, x, Align::kLeft);
    x += advance(piece, size);
  }
}

void Lettering::draw_with_rim(Canvas& canvas, const std::string& text, Point2 baseline, int size, Rgba colour) const {
  for (const double dx : {-2.0, 0.0, 2.0})
    for (const double dy : {-2.0, 0.0, 2.0})
      draw(canvas, text, {baseline.x + dx, baseline.y + dy}, size, {255, 255, 255});
  draw(canvas, text, baseline, size, colour);
}

int Lettering::width(const std::string& text, int size) const {
  if (!available()) return 0;
  const std::vector<PlainPiece> pieces = plain_pieces(text);
  if (pieces.size() == 1) return drawing().text_width(pieces.front().text.c_str(), {font_.c_str(), size});
  return std::accumulate(pieces.begin(), pieces.end(), 0,
                         [&](int sum, const PlainPiece& piece) { return sum + advance(piece, size); });
}

/// The width of a piece with the blanks at its ends, which its drawn width leaves out.
int Lettering::advance(const PlainPiece& piece, int size) const {
  const auto width_of = [&](const std::string& text) {
    return drawing().text_width(text.c_str(), {font_.c_str(), size_of(piece, size)});
  };
  return width_of(fmt::format("|{}|", piece.text)) - width_of("||");
}

void require_image_format(const std::string& path) {
  if (!drawing().knows_format(path.c_str()))
    throw InputError(fmt::format("{}: no image format for the ending '{}'; use .png or .jpg", path,
                                 fs::path(path).extension().string()));
}

std::string picture_bytes(const PictureSamples& samples, const std::string& path, int quality) {
  // The module does not change what it encodes.
  const Picture picture{const_cast<std::uint8_t*>(samples.values.data()), samples.width, samples.height,
                        samples.channels};
  std::string bytes;
  const char* const failed =
      drawing().encode(picture, path.c_str(), quality, &bytes, [](void* to, const void* from, std::size_t count) {
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
