#include "gdal/files/archive.hpp"

#include <algorithm>
#include <vector>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/file_ending.hpp>

#include "gdal/files/source_path.hpp"

namespace itin {

namespace {

bool is_vector_name(const std::string& name) {
  constexpr const char* kEndings[] = {".shp", ".gpkg", ".geojson", ".gml", ".kml",
                                      ".tab", ".mif",  ".fgb",     ".csv", ".tsv"};
  const std::string ending = ending_of(name);
  return std::any_of(std::begin(kEndings), std::end(kEndings), [&](const char* e) { return ending == e; });
}

}  // namespace

std::string within_archive(const std::string& path, const std::string& what) {
  if (ending_of(path) != ".zip" || path.starts_with("/vsi") || is_missing(path)) return path;
  require_plain_file(path);
  const std::string archive = "/vsizip/" + path;
  const CPLStringList names(VSIReadDirRecursive(archive.c_str()));
  std::vector<std::string> found;
  for (int i = 0; i < names.size(); ++i)
    if (is_vector_name(names[i])) found.emplace_back(names[i]);
  if (found.empty()) throw FileError(path, fmt::format("holds no {} that can be read; unpack other files first", what));
  if (found.size() > 1)
    throw FileError(path, fmt::format("holds several files, {}; unpack the one that is meant", found));
  return archive + "/" + found.front();
}

}  // namespace itin
