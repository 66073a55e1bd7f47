// The features that `--without` names, as reports print them.
#pragma once

#include <string>
#include <vector>

#include <itin/feature_at.hpp>
#include <itin/store.hpp>

namespace itin::cli {

/// Reads what `--without` gives: features with semicolons between, or a file with one in each line, in which empty
/// lines count for nothing. Throws InputError for an empty name, FileError.
std::vector<std::string> omitted_in(const std::string& text);

/// Returns the features of these names. A name is the theme's, and
///   - a colon and the feature's id or name: woods:17, houses:Town Hall;
///   - a comma and its title, as reports print it: houses, Town Hall (id 42);
///   - or # and its number: woods#16.
/// Throws InputError for a name of no feature or of several.
std::vector<FeatureNumber> features_called(const Store& store, const std::vector<std::string>& names);

}  // namespace itin::cli
