// Profiles that others hand in: `d_km,h_m[,clutter_m]`, one row a point, a header line optional.
#pragma once

#include <istream>
#include <string>

#include <profile/profile.hpp>

namespace itin::profile {

/// Columns are separated by commas, semicolons or tabs; a first line that is not numbers is a header, whose names (of
/// any case, in this order) are checked; empty lines and lines that begin with # are skipped; a decimal point, whatever
/// the locale. Distances ascend (two equal ones are a vertical face) and begin anywhere: the first is the profile's
/// origin. Throws InputError, naming `name` and the line, for anything else, for numbers that are not finite, negative
/// clutter, and fewer than two rows.
Profile read_profile_csv(std::istream& text, const std::string& name);

/// The same of a file. Throws FileError where it cannot be read.
Profile read_profile_csv(const std::string& path);

}  // namespace itin::profile
