// The only part that sees OpenImageIO.
#include <string>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "../src/drawing/picture_encoder.hpp"

namespace itin::viewshed {

namespace {

OIIO::ImageSpec spec_of(const Picture& picture) {
  return {picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8};
}

bool knows_format(const char* path) {
  const bool known = OIIO::ImageOutput::create(path) != nullptr;
  if (!known) OIIO::geterror();
  return known;
}

// Encodes into memory: several of the libraries beneath take no notice of a full disk, and libjpeg ends the program.
const char* encode(const Picture& picture, const char* path, int quality, void* to, Append append) {
  static thread_local std::string reason;
  OIIO::ImageSpec spec = spec_of(picture);
  spec.attribute("CompressionQuality", quality);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto output = OIIO::ImageOutput::create(path);
  OIIO::Filesystem::IOVecOutput bytes;
  const bool encoded = output && output->set_ioproxy(&bytes) && output->open(path, spec) &&
                       output->write_image(OIIO::TypeDesc::UINT8, picture.samples) && output->close();
  if (encoded) {
    append(to, bytes.buffer().data(), bytes.buffer().size());
    return nullptr;
  }
  reason = output ? output->geterror() : OIIO::geterror();
  return reason.c_str();
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const PictureEncoder itin_picture_encoder{knows_format, encode};

}  // namespace itin::viewshed
