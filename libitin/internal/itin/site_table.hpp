// Points with fields, one per row, from any vector file. Bad rows are kept, for lists that one bad row must not stop.
//
//   SiteQuery query;
//   query.path = "turbines.csv";
//   for (const SiteRow& row : read_site_rows(query, {{"hub_height"}, {"farm"}}, store.metadata().crs_wkt, warnings))
//     if (!row.error.empty()) report(row.place, row.error);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <itin/sites.hpp>

namespace itin {

struct SiteField {
  std::string name;
  bool required = false;  ///< if false, the field may be missing, and is then empty in every row
};

struct SiteRow {
  std::int64_t feature = 0;                        ///< the file's own number for the feature
  std::string place;                               ///< as Site::place
  std::optional<Point2> position;                  ///< in the CRS asked for; nothing: see `error`
  std::vector<std::optional<std::string>> values;  ///< one per field asked for; nothing where it is empty or not there
  std::string error;                               ///< why there is no position; one line
};

/// Returns all rows that query.where lets pass, in the file's order; each point of a multipoint is a row. A field is
/// found by its name, by one that same_column_name() says is the same, or by the first ten letters, which are what a
/// Shapefile keeps. query.height_field and name_field are not used. `warnings` is as that of read_sites(). Throws
/// FileError for a file, layer, required field or filter that is missing or not understood, InputError for a CRS that
/// is unknown and a filter that leaves nothing.
std::vector<SiteRow> read_site_rows(const SiteQuery& query, const std::vector<SiteField>& fields,
                                    const std::string& to_crs, std::vector<std::string>& warnings);

}  // namespace itin
