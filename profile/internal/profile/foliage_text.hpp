// What is said of a line through foliage.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <profile/foliage.hpp>

namespace itin::profile {

/// Returns `foliage` of a line's document.
Document foliage_document(const FoliageSight& sight, const Foliage& foliage);
/// Returns the same in a sentence, without a full stop.
std::string foliage_text(const FoliageSight& sight, const Foliage& foliage);

}  // namespace itin::profile
