// Files of the page, by HTTP.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "serve/http/http_message.hpp"

namespace itin::cli {

/// The file of this name, "map/map.js", or a failure with status 404.
HttpResponse page_answer(const std::string& name, bool may_be_kept);

/// What a browser takes a file for, by the ending of its name.
std::string content_type_of(const std::string& name);

/// A number that is another one for another page.
std::size_t page_version();

/// The header that lets a browser keep an answer, or that forbids it.
std::pair<std::string, std::string> cache_header(bool may_be_kept);

}  // namespace itin::cli
