// Writes the output of `itin profile`: tables, documents, lines and charts of the surface along a path.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <itin/store.hpp>
#include <profile/profile.hpp>

#include "program/verb.hpp"

namespace itin::cli {

using profile::SurfaceProfile;

/// Throws InputError unless the ending is one that write_profile() knows.
void require_profile_format(const std::string& path);
bool is_chart(const std::string& path);
/// Whether it is text for other programs, which holds one profile.
bool is_text(const std::string& path);

struct ProfileOutput {
  const StoreMetadata& metadata;
  const std::vector<SurfaceProfile>& profiles;
  const profile::Profile& ground;  ///< for charts and text: the first one without raised features; may be empty
  Document document;               ///< the whole, for .json
  std::string title;               ///< the charts' title
  std::vector<double> corners_m;   ///< for charts: the distances at which the line turns
  bool overwrite = false;
};

/// Writes the format that the ending names: .csv, .txt, .json, .geojson; .svg, .pdf, .png. Throws InputError,
/// FileError.
void write_profile(const ProfileOutput& output, const std::string& path);

}  // namespace itin::cli
