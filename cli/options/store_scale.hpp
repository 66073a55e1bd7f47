// Tells how true lengths in a store are, for documents.
#pragma once

#include <optional>

#include <itin/store_scale.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// The document `scale`: `least` and `greatest`, or null.
Document scale_document(const std::optional<GridScale>& scale);

}  // namespace itin::cli
