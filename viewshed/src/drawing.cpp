#include "drawing.hpp"

#include <dlfcn.h>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::viewshed {

namespace {

namespace fs = std::filesystem;

/// Beside the running program, as installed and as built; or where it was to be installed, for programs that use the
/// library.
fs::path module_path() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  fs::path beside = (program.parent_path() / ITIN_DRAWING_FROM_PROGRAM).lexically_normal();
  return !error && fs::exists(beside, error) ? beside : fs::path(ITIN_DRAWING_INSTALLED);
}

const Drawing& load() {
  const fs::path path = module_path();
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const found = module == nullptr ? nullptr : dlsym(module, "itin_drawing");
  if (found == nullptr) throw FileError(path.string(), fmt::format("maps cannot be drawn without it: {}", dlerror()));
  return *static_cast<const Drawing*>(found);
}

}  // namespace

const Drawing& drawing() {
  static const Drawing& loaded = load();
  return loaded;
}

}  // namespace itin::viewshed
