// The themes and features of a viewshed over a store.
#pragma once

#include <cstdint>
#include <string>

#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <viewshed/result.hpp>

namespace itin::viewshed {

/// Takes names from the store that the result was made of: the names of its themes, and the features that its blockers
/// are part of. Throws Cancelled where `progress` asks for it.
void name_features(const Store& store, Result& result, const Progress& progress);

/// The name of a value of the result's `blocker_theme`, which is not kNoBlocker.
std::string blocker_name(const Result& result, std::uint32_t theme);

}  // namespace itin::viewshed
