#include "serve/http/page_answer.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include <itin/file_ending.hpp>

#include "serve/http/page_files.hpp"

namespace itin::cli {

HttpResponse page_answer(const std::string& name, bool may_be_kept) {
  const auto files = page_files();
  const auto file = std::find_if(files.begin(), files.end(), [&](const PageFile& f) { return f.name == name; });
  if (file == files.end()) return http_failure(404, fmt::format("the page has no file '{}'", name));
  return {
      200, content_type_of(name), std::string(file->gzip), {{"Content-Encoding", "gzip"}, cache_header(may_be_kept)}};
}

std::string content_type_of(const std::string& name) {
  constexpr std::pair<const char*, const char*> kTypes[] = {{".html", "text/html; charset=utf-8"},
                                                            {".js", "text/javascript; charset=utf-8"},
                                                            {".mjs", "text/javascript; charset=utf-8"},
                                                            {".css", "text/css; charset=utf-8"},
                                                            {".json", "application/json"},
                                                            {".svg", "image/svg+xml"},
                                                            {".png", "image/png"},
                                                            {".ico", "image/x-icon"},
                                                            {".woff2", "font/woff2"},
                                                            {".txt", "text/plain; charset=utf-8"},
                                                            {".wasm", "application/wasm"},
                                                            {".tif", "image/tiff"},
                                                            {".glb", "model/gltf-binary"},
                                                            {".pdf", "application/pdf"},
                                                            {".gpkg", "application/geopackage+sqlite3"}};
  for (const auto& [ending, type] : kTypes)
    if (ending_of(name) == ending) return type;
  return "application/octet-stream";
}

std::size_t page_version() {
  std::string all;
  for (const PageFile& file : page_files()) all.append(file.name).append(file.gzip);
  return std::hash<std::string>()(all);
}

std::pair<std::string, std::string> cache_header(bool may_be_kept) {
  return {"Cache-Control", may_be_kept ? "private, max-age=31536000, immutable" : "no-cache"};
}

}  // namespace itin::cli
