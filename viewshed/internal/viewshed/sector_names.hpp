// What antennas at one place are called together. The sectors of a mast have the beginning of their names in common.
//
//   shared_beginning({"Cwm A", "Cwm B"});  // "Cwm"
//   names_together({"Cwm A", "Cwm B"});    // "Cwm A, B"
#pragma once

#include <string>
#include <vector>

namespace itin::viewshed {

/// Returns what all names begin with, up to a blank, a mark or the end of a name. Returns nothing where there is no
/// such beginning, and the name itself where all are equal. There is at least one name.
std::string shared_beginning(const std::vector<std::string>& names);

/// Returns the names, of which there is at least one, as one label: what they have in common stands once, and so do
/// equal names.
std::string names_together(const std::vector<std::string>& names);

}  // namespace itin::viewshed
