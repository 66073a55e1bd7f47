// Many lines of sight over one surface, in parallel.
//
//   const profile::LinkTable table = profile::read_link_table("links.csv", store.metadata().crs_wkt, {2, 2});
//   profile::LinkQuery query;
//   query.radio = profile::RadioPath{.frequency_ghz = 7.5};
//   for (const profile::LinkResult& row : profile::survey_links(store, table.links, query, progress))
//     std::cout << (row.found ? profile::name_of(row.found->verdict) : row.message) << '\n';
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/theme.hpp>
#include <profile/los.hpp>
#include <profile/required_heights.hpp>

namespace itin {
class Store;
}

namespace itin::profile {

/// A link between two places. Heights are metres above what the ends stand on.
struct Link {
  std::string id;
  Point2 from;
  double from_height = 0;
  Point2 to;
  double to_height = 0;
  // What its file tells about this link alone:
  std::string from_name = {}, to_name = {};
  std::optional<double> frequency_ghz = {};
  std::optional<Polarisation> polarisation = {};
  std::vector<Criterion> criteria = {};
  std::vector<std::string> others = {};  ///< the cells of LinkTable::other_columns
};

/// Antenna heights, above what the ends stand on, of links whose file gives none.
struct LinkHeights {
  double from_m = 0, to_m = 0;
};

/// Which lines of a file of lines are links: by default all lines of all layers.
struct LinkChoice {
  std::string layer = {};  ///< the only layer to read
  std::string where = {};  ///< a condition in OGR's SQL
};

/// A row, or a feature of a file of lines, that cannot be understood.
struct BadLink {
  std::size_t row = 0;  ///< from 1, not counting the header
  std::string place;    ///< "line 7" of a table, "feature 3" by the file's own number
  std::string id;       ///< if there is one
  std::string message;
  std::vector<std::string> others = {};  ///< as Link::others
};
struct LinkTable {
  std::vector<Link> links;
  std::vector<BadLink> bad;                ///< in order
  std::vector<std::string> other_columns;  ///< names of columns that are not understood, but kept for the output
  std::vector<std::string> warnings;       ///< about what was read otherwise than it may be meant, a line each
};

/// Reads a table `id,x1,y1,h1,x2,y2,h2`, if the name ends in .csv, .tsv or .txt, in whatever case. Otherwise reads a
/// file of lines, whose ends are the links' ends at `heights` above the surface.
///
/// A table may have a header. If that has these names, the columns may come in another order, and there may be
/// others: `name1`, `name2`, `frequency`, `polarisation` and `criteria` (with blanks between several) of each link, and
/// further ones that are kept. `name` or `link` may stand for `id`; where none of the three is there, links have the
/// numbers of their rows from 1. Easting and northing, or lon and lat, each with 1 or 2 behind it, may stand for x and
/// y; so may `position1` and `position2` (or `gridref1` and `gridref2`) with grid references, or with latitudes and
/// longitudes in degrees and their letters. Semicolons or tabs may separate the columns, and a comma that cannot
/// part thousands is decimal.
///
/// The links are in the CRS `to_crs` (WKT). CSV tables, and layers whose CRS is missing, not defined or
/// cannot be theirs, are taken to be in `csv_crs`; if that is empty, in longitude and
/// latitude where the header calls them so, else in `to_crs`. Throws FileError for a file that is missing or not
/// understood, or has no such layer or field, InputError for an unknown CRS, for a header that has some of these names
/// without the others, for a file without links, and for a choice that makes no sense, leaves nothing or is of the rows
/// of a table.
LinkTable read_link_table(const std::string& path, const std::string& to_crs, const LinkHeights& heights,
                          const std::string& csv_crs = {}, const LinkChoice& choice = {});

struct LinkQuery {
  Earth earth;
  Detail detail = Detail::tolerance(0);      ///< the surface's level of detail
  ThemeChoice themes = ThemeChoice::none();  ///< raised features on the surface
  /// Whether an end within a raised feature stands on the feature, or else on the ground under it.
  bool from_on_surface = false, to_on_surface = false;
  // These are for links that have none of their own:
  std::optional<RadioPath> radio = {};    ///< gives Fresnel clearances and losses
  std::vector<Criterion> criteria = {};   ///< with a fraction > 0 only for links with a frequency
  std::optional<TallObject> object = {};  ///< the object at each second end; gives LinkResult::visible
  NoData nodata = NoData::kUnknown;
  /// The data that each surface keeps for the links that follow; it changes the speed only.
  SectionSurface::Options sections = {};
  /// The day of magnetic azimuths; if it is given, tables have these besides the others.
  std::optional<std::chrono::year_month_day> day = {};
};

struct LinkResult {
  double distance_m = 0;
  std::optional<LineFindings> found;  ///< nothing after an error; without obstructions and curves
  EndGrounds stands_on;               ///< elevations of what the ends stand on
  double gap_m = 0;                   ///< length of the parts of the distance without data
  std::optional<RadioPath> radio;
  std::optional<PathLosses> losses;  ///< nothing without `radio`, without a length, or with an antenna within a feature
  std::optional<Reflection> reflection;
  std::optional<VisibleHeight> visible;
  std::string message;  ///< what went wrong, where there was an error
  // What was read for this link; anything that links share is counted where it was read first:
  RetrievalStatistics statistics;
  std::uint64_t triangles = 0;  ///< crossed by the line
};

/// Returns one result per link, in order, whatever the number of threads. Links over one area share the tiles that are
/// read and triangulated for them. The answers are those of analyse() to the last bit. A link that cannot be computed
/// (no ground under an end) is an error row. Required heights are found for links with a frequency or criteria. Throws
/// InputError for a theme that the store does not have, CorruptStore, FileError, Cancelled.
std::vector<LinkResult> survey_links(const Store& store, const std::vector<Link>& links, const LinkQuery& query,
                                     Progress& progress);

/// The JSON document that `itin los --links --json` prints, without the call and its outputs: the number of links by
/// verdict.
std::string json_of(const StoreMetadata& metadata, const LinkTable& table, const std::vector<LinkResult>& results,
                    const LinkQuery& query);

/// The query of one link: its own frequency, polarisation and criteria, or those of `query`.
LosQuery los_query(const Link& link, const LinkQuery& query);

/// Computes one link by itself. Throws InputError where it cannot be computed, CorruptStore, FileError.
LinkResult survey_link(const Store& store, const Link& link, const LinkQuery& query);

}  // namespace itin::profile
