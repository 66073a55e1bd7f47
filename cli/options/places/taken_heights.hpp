// The line that tells from which field of a list heights were taken though no option named it.
#pragma once

#include <string>

#include <fmt/format.h>

namespace itin::cli {

/// `what` has these heights: observers, masts or targets. Empty without a field.
inline std::string taken_heights_text(const char* what, const std::string& field, const std::string& path) {
  return field.empty() ? "" : fmt::format("heights of {} are those of the field '{}' of {}\n", what, field, path);
}

}  // namespace itin::cli
