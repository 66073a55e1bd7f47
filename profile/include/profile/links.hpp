// Many lines of sight over one surface, in parallel: read from a table, judged, and written as tables.
//
//   profile::LinkTable table = profile::read_link_table("links.csv", store.metadata().crs_wkt, {2, 2});
//   profile::LinkQuery query;
//   query.radio = profile::RadioPath{.frequency_ghz = 7.5};
//   const profile::LinkSurvey survey = profile::survey_link_table(store, std::move(table), query, progress);
//   profile::write_link_table(survey, {"judged.csv", "judged.gpkg"});
//   for (const profile::LinkResult& row : survey.results)
//     std::cout << (row.found ? profile::name_of(row.found->verdict) : row.message) << '\n';
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <profile/los.hpp>
#include <profile/required_heights.hpp>

namespace itin::profile {

/// A link between two places. Heights are metres above what the ends stand on.
struct Link {
  std::string id = {};
  Point2 from = {};
  double from_height = 0;
  Point2 to = {};
  double to_height = 0;
  // What its file tells about this link alone:
  std::string from_name = {}, to_name = {};
  std::optional<double> frequency_ghz = {};
  std::optional<Polarisation> polarisation = {};
  std::vector<Criterion> criteria = {};
  BudgetQuery budget = {};               ///< in place of what the query's has
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
  std::string path = {};                   ///< the file; empty: the links are not from a file
};

/// Reads a table `id,x1,y1,h1,x2,y2,h2`, if the name ends in .csv, .tsv or .txt, in whatever case. Otherwise reads a
/// file of lines, whose ends are the links' ends at `heights` above the surface.
///
/// A table may have a header. If that has these names, the columns may come in another order, and there may be
/// others: `name1`, `name2`, `frequency`, `polarisation` and `criteria` (with blanks between several) of each link,
/// those of its budget (`power_dbm` or `eirp_dbm`, `gain1_dbi`, `gain2_dbi`, `feeder_loss1_db`, `feeder_loss2_db`,
/// `sensitivity_dbm`, `rain_rate_mm_h`, `geoclimatic_factor` or `refractivity_gradient`), and further ones that are
/// kept. `name` or `link` may stand for `id`; where none of the three is there, links have the numbers of their rows
/// from 1. Easting and northing, or lon and lat, each with 1 or 2 behind it, may stand for x and y; so may `position1`
/// and `position2` (or `gridref1` and `gridref2`) with grid references, with latitudes and longitudes in degrees and
/// their letters or as "54.523388, -3.145489", or with `x,y`. Semicolons or tabs may separate the columns, and a comma
/// that cannot part thousands is decimal.
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
  Earth earth = {};
  Detail detail = Detail::tolerance(0);      ///< the surface's level of detail
  ThemeChoice themes = ThemeChoice::none();  ///< raised features on the surface
  /// Whether an end within a raised feature stands on the feature, or else on the ground under it.
  bool from_on_surface = false, to_on_surface = false;
  // These are for links that have none of their own:
  std::optional<RadioPath> radio = {};    ///< gives Fresnel clearances and losses
  BudgetQuery budget = {};                ///< gives budgets of links with a frequency
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

/// Finds what survey_links() finds of a line whose profiles are known, without required heights and what was read;
/// see judge().
LinkResult judge_link(const Profile& profile, const LosQuery& query, const Profile& ground = {});

/// The budget of a link that was surveyed by this query; nothing without losses, and where none is asked for. Without
/// the latitude of its middle, the year fades as the worst month does.
std::optional<LinkBudget> link_budget_of(const Link& link, const LinkResult& result, const LinkQuery& query,
                                         std::optional<double> latitude_deg = {});

/// The query of one link: its own frequency, polarisation, criteria and budget, or those of `query`.
LosQuery los_query(const Link& link, const LinkQuery& query);

/// Computes one link by itself. Throws InputError where it cannot be computed, CorruptStore, FileError.
LinkResult survey_link(const Store& store, const Link& link, const LinkQuery& query);

/// Where on the Earth a link's ends are, and the geodesic between them.
struct LinkCourse {
  Point2 from = {}, to = {};  ///< longitude and latitude
  double distance_m = 0;
  double azimuth_deg = 0;       ///< at the first end, towards the second, from true north
  double back_azimuth_deg = 0;  ///< at the second end, towards the first
};

/// The links of a table and what was found: all that files and documents about them tell.
struct LinkSurvey {
  LinkTable table;
  LinkQuery query;
  std::vector<LinkResult> results;                 ///< one per link of the table, in order
  std::vector<std::optional<LinkCourse>> courses;  ///< likewise; nothing where an end is no place on the Earth
  /// Likewise; nothing without LinkResult::losses, and where none is asked for.
  std::vector<std::optional<LinkBudget>> budgets;
  std::string store;  ///< the store's path
  StoreMetadata metadata;
  std::vector<std::string> warnings;  ///< those of the table, and about columns and ground without data, a line each
};

/// Surveys the links of a table. Throws what survey_links() throws, and InputError for a CRS that has no longitude and
/// latitude.
LinkSurvey survey_link_table(const Store& store, LinkTable table, const LinkQuery& query, Progress& progress);

struct LinkCounts {
  std::size_t visible = 0, hidden = 0, undecided = 0, error = 0;
};
/// Counts the links by verdict. Rows that cannot be understood are errors, too.
LinkCounts counts_of(const LinkSurvey& survey);

/// The JSON document that `itin los --links --json` prints, without the call and its outputs: the number of links by
/// verdict.
std::string json_of(const LinkSurvey& survey);

struct LinkFileOptions {
  std::string title = "Line-of-sight report";                   ///< the title of pages and maps
  std::vector<std::pair<std::string, std::string>> facts = {};  ///< what pages tell first: name, value
  bool overwrite = false;
  /// The map of all links, as viewshed::links_map() makes it; null: the .pdf has none.
  std::shared_ptr<const MapSheet> map = {};
};

/// Writes each file by its name's ending: .csv (a row per row of the table), .gpkg and .kml (the links that could be
/// computed, as lines), .pdf (the number of links by verdict, the links that need attention first, and the map). Equal
/// surveys give equal bytes. Throws what require_link_format() throws, and FileError.
void write_link_table(const LinkSurvey& survey, const std::vector<std::string>& paths,
                      const LinkFileOptions& options = {});

/// Throws InputError for any other ending than write_link_table() knows.
void require_link_format(const std::string& path);

}  // namespace itin::profile
