// What maps of a viewshed are called, by mode.
#pragma once

#include <string>

#include <viewshed/viewshed.hpp>

namespace itin::cli {

std::string title_of(const viewshed::Result& result);

}  // namespace itin::cli
