#include "gdal/files/source_path.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/raster_values.hpp>

#include "gdal/files/network.hpp"
#include "gdal/files/quiet_gdal.hpp"

namespace itin {

namespace {

namespace fs = std::filesystem;

}  // namespace

bool is_missing(const std::string& path) {
  const QuietGdal quiet;
  VSIStatBufL status;
  take_refusal();
  const bool missing = VSIStatL(path.c_str(), &status) != 0;
  require_no_refusal(path);
  return missing;
}

void require_plain_file(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (path.starts_with("/vsi") || !fs::exists(status) || fs::is_directory(status)) return;
  if (!fs::is_regular_file(status))
    throw FileError(path, "is a pipe or device, not a file; save what it gives to a file first");
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
    throw FileError(path, "cannot be opened: " + std::generic_category().message(errno));
  if (fs::file_size(path, ignored) == 0) throw FileError(path, "is empty");
}

std::string why_not_read(const std::string& path, const std::string& what) {
  const std::string said = QuietGdal::message("GDAL knows no such format");
  if (is_missing(path)) return "there is no such file";
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    return fmt::format("is a directory, and none that can be read as {}; name the files in it", what);
  if (what != "a raster" && is_raster(path)) return fmt::format("is a raster, not {}", what);
  return fmt::format("cannot be read as {}: {}", what, said);
}

}  // namespace itin
