// The columns of a file of masts that tell of the antenna of each: `antenna` (the file of a pattern), `azimuth`,
// `tilt`.
//
//   AntennaColumns antennas(query);  // asks for the columns
//   for (const Site& site : read_sites(query, crs, warnings)) budget.from_antenna = antennas.of(site);
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

#include <itin/sites.hpp>
#include <profile/diffraction.hpp>

namespace itin::profile {

class AntennaColumns {
 public:
  /// Adds the columns to what the query reads.
  explicit AntennaColumns(SiteQuery& query);
  /// Returns what the site's cells tell; where they are empty, nothing. The path of a pattern is relative to the folder
  /// of the file. Throws InputError and FileError, which name the site, for a pattern that cannot be read, and for a
  /// tilt beyond 90 degrees.
  AimedAntenna of(const Site& site);

 private:
  std::string path_;
  std::size_t number_, text_;  ///< the first of these columns among the query's
  std::map<std::string, std::shared_ptr<const AntennaPattern>> patterns_;
};

}  // namespace itin::profile
