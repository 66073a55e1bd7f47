// What is said of a line through foliage.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <profile/foliage.hpp>

namespace itin::profile {

/// Says in words how woods are seen through.
std::string foliage_rule_text(const Foliage& foliage);

/// Returns `foliage` of a line's document.
Document foliage_document(const FoliageSight& sight, const Foliage& foliage);
/// Returns the same in a sentence, without a full stop.
std::string foliage_text(const FoliageSight& sight, const Foliage& foliage);

/// Returns `foliage` of a profile's document, with the names of themes by ProfilePoint::theme.
Document foliage_document(const PathFoliage& path, const std::vector<std::string>& themes);
/// Returns the same in a sentence, without a full stop.
std::string foliage_text(const PathFoliage& path);

}  // namespace itin::profile
