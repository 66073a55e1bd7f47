// Lists of places from files: the fields they take where the call names none, and the error about a list of none.
//
// Whatever the verb, a height in the field `height` comes before the default of the option that states heights of such
// places, and after that option where the call gives it.
#pragma once

#include <string>
#include <vector>

#include <itin/sites.hpp>

namespace itin::cli {

/// The fields that heights and names are in where the call names no others.
inline constexpr const char *kHeightField = "height", *kNameField = "name";

/// Lets the query take heights from kHeightField where it names no field and the file has that one. `given`: an option
/// of the call that states these heights, which leaves the field unused, with a warning; empty where there is none.
/// `fields` are those of the query's file, here as below.
void take_heights(SiteQuery& query, const LayerFields& fields, const std::string& given,
                  std::vector<std::string>& warnings);

/// Lets the query take names from kNameField where it names no field and the file has that one.
void take_names(SiteQuery& query, const LayerFields& fields);

/// Warns of a field that the file has and that nobody reads unless `option` names it.
void warn_of_unused(const SiteQuery& query, const LayerFields& fields, const std::string& field,
                    const std::string& option, std::vector<std::string>& warnings);

/// The error about a file of places that holds none. Names the option that may have left all out, where there is one.
std::string none_in(const SiteQuery& query, const char* what);

}  // namespace itin::cli
