// The files of the page, which the build embeds in the program: those of cli/serve/page, compressed.
#pragma once

#include <span>
#include <string_view>

namespace itin::cli {

struct PageFile {
  std::string_view name;  ///< relative to cli/serve/page, "map/map.js"
  std::string_view gzip;  ///< its bytes, as gzip compresses them
};

/// All of them, by name. embed_page.cmake writes this function's source.
std::span<const PageFile> page_files();

}  // namespace itin::cli
