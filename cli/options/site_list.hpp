// Lists of places from files: the fields that are read where the call names none, and the error about an empty list.
//
// For every verb, a height in the field `height` goes before the default of the option that states heights of such
// places; where the call gives that option, the option goes first.
#pragma once

#include <string>
#include <vector>

#include <itin/sites.hpp>

namespace itin::cli {

/// The fields with heights and names where the call names no others.
inline constexpr const char *kHeightField = "height", *kNameField = "name";

/// Lets the query take heights from kHeightField where the query names no field and the file has that one. `given` is
/// an option of the call that states these heights; then the field stays unused, with a warning. It is empty where
/// there is none. `fields` are the fields of the query's file, here as below.
void take_heights(SiteQuery& query, const LayerFields& fields, const std::string& given,
                  std::vector<std::string>& warnings);

/// Lets the query take names from kNameField where the query names no field and the file has that one.
void take_names(SiteQuery& query, const LayerFields& fields);

/// Warns of a field that the file has and that nobody reads unless `option` names it.
void warn_of_unused(const SiteQuery& query, const LayerFields& fields, const std::string& field,
                    const std::string& option, std::vector<std::string>& warnings);

/// The error about a file of places that holds none. Names the option that may have left all of them out, if there is
/// one.
std::string none_in(const SiteQuery& query, const char* what);

}  // namespace itin::cli
