#include "drawing/picture_encoder.hpp"

#include <dlfcn.h>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::viewshed {

namespace {

constexpr const char* kModule = "itin-drawing.so";

/// Loads the module by its name alone. The dynamic linker looks for it where this library, or the program that it was
/// linked into, says (RUNPATH: viewshed/CMakeLists.txt), so that it is found wherever an installation has been moved.
const PictureEncoder& load() {
  void* const module = dlopen(kModule, RTLD_NOW | RTLD_LOCAL);
  void* const found = module == nullptr ? nullptr : dlsym(module, "itin_picture_encoder");
  if (found == nullptr) throw FileError(kModule, fmt::format("maps cannot be drawn without it: {}", dlerror()));
  return *static_cast<const PictureEncoder*>(found);
}

}  // namespace

const PictureEncoder& picture_encoder() {
  static const PictureEncoder& loaded = load();
  return loaded;
}

}  // namespace itin::viewshed
