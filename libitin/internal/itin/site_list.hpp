// Lists of places from files: the fields that are read where the call names none, and the error about an empty list.
//
// For every verb, a height in the field `height` goes before the default of the option that states heights of such
// places; where the call gives that option, the option goes first.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/sites.hpp>

namespace itin {

/// The fields with heights and names where the call names no others.
inline constexpr const char *kHeightField = "height", *kNameField = "name";

/// What a call says of the heights of a list of places.
struct HeightChoice {
  std::string given = {};              ///< the option of the call that states these heights; empty: there is none
  std::string field_option = {};       ///< the option that names the field with heights; empty: there is none
  std::vector<std::string> used = {};  ///< fields that are read for something else
};

/// Lets the query take heights from kHeightField where the query names no field and the file has that one. Where the
/// call states these heights, the field stays unused, with a warning. A warning tells of other fields that seem to hold
/// heights. `fields` are the fields of the query's file, here as below.
void take_heights(SiteQuery& query, const LayerFields& fields, const HeightChoice& choice,
                  std::vector<std::string>& warnings);

/// The field of names: kNameField, or else the only field that seems to hold names; nothing where there is none.
std::optional<std::string> name_field_of(const LayerFields& fields);

/// Lets the query take names from name_field_of() where the query names no field.
void take_names(SiteQuery& query, const LayerFields& fields);

/// Warns of a field that the file has and that nobody reads unless `option` names it.
void warn_of_unused(const SiteQuery& query, const LayerFields& fields, const std::string& field,
                    const std::string& option, std::vector<std::string>& warnings);

/// The error about a file of places that holds none. Names the option that may have left all of them out, if there is
/// one.
std::string none_in(const SiteQuery& query, const char* what);

}  // namespace itin
