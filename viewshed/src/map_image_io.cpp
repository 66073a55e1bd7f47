// All that maps need of OpenImageIO: lettering and files.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <unistd.h>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <itin/error.hpp>
#include <viewshed/map_image.hpp>

#include "lettering.hpp"
#include "plain_text.hpp"

namespace itin::viewshed {

namespace {

namespace fs = std::filesystem;

std::string find_font() {
  std::vector<fs::path> places{"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts", "/System/Library/Fonts"};
  if (const char* home = std::getenv("HOME")) places.push_back(fs::path(home) / ".local/share/fonts");
  // The earlier the better: metrics differ little, but a machine should always choose the same.
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

OIIO::ImageSpec spec_of(int width, int height) {
  return {width, height, 3, OIIO::TypeDesc::UINT8};
}

}  // namespace

Lettering::Lettering() : font_(find_font()) {}

void Lettering::draw(Canvas& canvas, const std::string& text, Point2 baseline, int size, Colour colour,
                     Align align) const {
  if (!available()) return;
  using OIIO::ImageBufAlgo::TextAlignX;
  OIIO::ImageBuf image(spec_of(canvas.width(), canvas.height()), canvas.rgb().data());
  const std::array<float, 3> rgb{colour.red / 255.0F, colour.green / 255.0F, colour.blue / 255.0F};
  const TextAlignX x = align == Align::kLeft     ? TextAlignX::Left
                       : align == Align::kCentre ? TextAlignX::Center
                                                 : TextAlignX::Right;
  OIIO::ImageBufAlgo::render_text(image, static_cast<int>(baseline.x), static_cast<int>(baseline.y), plain_text(text),
                                  size, font_, rgb, x);
}

void Lettering::draw_with_rim(Canvas& canvas, const std::string& text, Point2 baseline, int size, Colour colour) const {
  for (const double dx : {-2.0, 0.0, 2.0})
    for (const double dy : {-2.0, 0.0, 2.0})
      draw(canvas, text, {baseline.x + dx, baseline.y + dy}, size, {255, 255, 255});
  draw(canvas, text, baseline, size, colour);
}

int Lettering::width(const std::string& text, int size) const {
  return available() ? OIIO::ImageBufAlgo::text_size(plain_text(text), size, font_).width() : 0;
}

void write_image(const std::string& path, const MapImage& image, bool overwrite) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw FileError(path, "is a directory; name a file");
  if (fs::exists(path, error) && !overwrite)
    throw FileError(path, "exists already; allow overwriting or name another file");
  const fs::path ending = fs::path(path).extension();
  const std::string temporary = fmt::format("{}.{}.tmp{}", path, getpid(), ending.string());
  const auto output = OIIO::ImageOutput::create(temporary);
  if (!output) {
    OIIO::geterror();
    throw InputError(fmt::format("{}: no image format for the ending '{}'; use .png", path, ending.string()));
  }
  const bool written = output->open(temporary, spec_of(image.width, image.height)) &&
                       output->write_image(OIIO::TypeDesc::UINT8, image.rgb.data()) && output->close();
  if (written) fs::rename(temporary, path, error);
  if (written && !error) return;
  const std::string reason = written ? error.message() : output->geterror();
  fs::remove(temporary, error);
  throw FileError(path, "cannot be written: " + reason);
}

}  // namespace itin::viewshed
