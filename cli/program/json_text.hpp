// Documents as text.
#pragma once

#include <string>

#include "program/verb.hpp"

namespace itin::cli {

/// `indent` as in nlohmann's dump(). Names of files and features have whatever bytes they have: what of them is not
/// UTF-8 is replaced by U+FFFD.
inline std::string json_text(const Document& document, int indent = -1) {
  return document.dump(indent, ' ', false, Document::error_handler_t::replace);
}

}  // namespace itin::cli
