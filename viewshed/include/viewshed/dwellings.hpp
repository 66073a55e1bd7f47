// What a wind farm is to the dwellings about it: what is seen of it from each facade, and shadow flicker, minute by
// minute of a year.
//
//   viewshed::DwellingsRequest wanted;
//   wanted.turbines = viewshed::read_turbines({.path = "turbines.csv"}, store.metadata().crs_wkt);
//   wanted.flicker.year = {.year = 2027, .utc_offset_minutes = 60};
//   const viewshed::DwellingsSurvey survey = viewshed::survey_dwellings(store, wanted, progress);
//   for (const viewshed::Dwelling& house : survey.dwellings)
//     std::cout << house.name << ": " << viewshed::flicker_sum(survey, house).hours() << " hours\n";
//   viewshed::write_dwellings("dwellings", store, survey, {}, progress);
//
// A dwelling is a building of the store, looked from before each of its facades, or a place in the open. A facade is a
// straight run of walls; its eye is before the middle, and takes in what is before the wall. A turbine is an upright
// axis (turbines.hpp). It is looked at over the bare ground and over the surface with the themes, however far it is.
// Each sight is a line from the eye that `itin los` gives the same verdict.
//
// Flicker is the worst case: the sun shines all day, the rotor turns, and faces the sun. The sun is a point. It is
// behind a rotor where the ray to it passes the hub no farther away than the rotor's radius. Whatever stands on the
// surface with the themes hides it, before the turbine and behind; ground without data does not.
//
// Positions are in the store's CRS, lengths in metres. InputError and warnings name fields between backticks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <itin/earth.hpp>
#include <itin/geometry.hpp>
#include <itin/progress.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <profile/sheet_choice.hpp>
#include <viewshed/result.hpp>
#include <viewshed/site_plan.hpp>
#include <viewshed/zone_study.hpp>

namespace itin::viewshed {

/// A year of minutes by a clock that is never put forward or back.
struct FlickerYear {
  int year = 2027;             ///< 1950 to 2100
  int utc_offset_minutes = 0;  ///< how far the clock is ahead of universal time
};

/// The parts of a month's daylight in which the sun shines, and in which the turbines turn.
struct MonthShare {
  double sunshine = 1, operation = 1;
};

struct FlickerRules {
  FlickerYear year = {};
  double least_elevation_deg = 3;          ///< lower suns throw no shadow; 1 at least
  double reach_diameters = 10;             ///< how far a shadow reaches, in diameters of the rotor
  std::optional<double> blade_width = {};  ///< with it, a shadow reaches as far as a blade hides a fifth of the sun
  double limit_minutes_year = 30 * 60, limit_minutes_day = 30;
  std::optional<std::array<MonthShare, 12>> months = {};  ///< with these, the likely minutes are told as well
};

/// How far the shadow of a blade reaches, in widths of the blade.
inline constexpr double kReachOfBlade = 687;

/// Reads the shares of months from a table with the columns month (1 to 12), sunshine and operation (0 to 1), one of
/// which may be missing. Throws FileError, InputError.
std::array<MonthShare, 12> read_months(const std::string& path);

/// Reads dwellings from a vector file of points, or from CSV with columns x,y or lon,lat, in the CRS `to_crs` (WKT). Of
/// a file that states no CRS, it is `crs`, or else `to_crs`. Names are those of the field `name`, or rows from 1.
/// Throws FileError, InputError where the file has none.
SitePlaces read_dwellings(const std::string& path, const std::string& crs, const std::string& to_crs);

struct DwellingsRequest {
  TurbineTable turbines = {};
  /// The dwellings. One that lies on a building of the themes is that building, any other a place in the open. Without
  /// any, all buildings of the themes are dwellings.
  SitePlaces dwellings = {};
  std::string dwelling_theme = {};  ///< the theme whose buildings are dwellings; empty: any
  double radius = 2000;   ///< dwellings are studied up to this distance from a turbine, and within reach of its shadow
  double eye_height = 2;  ///< above the bare ground
  FlickerRules flicker = {};
  Earth earth = {};
  ThemeChoice themes = ThemeChoice::all();  ///< what stands on the ground
  NoData nodata = NoData::kUnknown;         ///< what ground without data does to sights of turbines
  std::optional<ZoneFoliage> foliage = {};  ///< with it, what is seen through woods is told as well
  /// Changes the speed, never the result. Of the ground at most this much is in memory at once, or 64 MB.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
};

/// Minutes one after the other on one day.
struct FlickerRun {
  std::uint32_t first = 0;  ///< minute of the year, from 0, by the clock of FlickerYear
  std::uint32_t minutes = 0;
  friend bool operator==(const FlickerRun&, const FlickerRun&) = default;
};

/// The flicker of one turbine.
struct TurbineFlicker {
  std::size_t turbine = 0;  ///< its index in the request
  std::vector<FlickerRun> runs;
};

/// An eye before a facade, or in the open.
struct DwellingFacade {
  Point2 position = {};
  double ground_m = 0;                       ///< elevation of the bare ground there
  std::optional<double> outward_deg = {};    ///< grid azimuth to which the facade looks; nothing: in the open
  double length_m = 0;                       ///< how long the facade is
  std::vector<TurbineFlicker> flicker = {};  ///< that of each turbine that has any, in their order
  /// What is seen of each turbine, over the bare ground, and over the surface with the themes: empty where none of them
  /// stands on the ground. A turbine behind the facade is Verdict::kOutside.
  std::vector<TurbineSight> bare = {}, screened = {};
  /// What is seen over the surface through its woods, in leaf and in winter; empty without foliage in the request, or
  /// where `screened` is.
  std::vector<TurbineSight> summer = {}, winter = {};
};

struct Dwelling {
  std::string name = {}, id = {};              ///< the given place's name; else as FeatureAt has them
  std::uint16_t theme = 0;                     ///< the building's, from 1; 0: in the open
  std::int64_t feature = -1;                   ///< the building's, as FeatureAt::number; -1: in the open
  Point2 position = {};                        ///< the given place, or the middle of the building's box
  std::vector<std::vector<Point2>> foot = {};  ///< the building's closed rings
  std::vector<DwellingFacade> facades = {};
  std::size_t nearest = 0;  ///< the nearest turbine: its index in the request
  double nearest_m = 0;     ///< horizontal distance of `position` to it
};

struct DwellingsSurvey {
  DwellingsRequest request;      ///< without turbines that have no ground
  std::vector<double> ground_m;  ///< bare ground under each turbine
  std::vector<Dwelling> dwellings;
  StoreMetadata metadata;
  std::vector<std::string> warnings;  ///< a line each
  Statistics statistics;
};

/// Flicker on some days.
struct FlickerSum {
  std::uint32_t minutes = 0;                 ///< in the year
  std::uint32_t days = 0;                    ///< days with flicker
  std::uint32_t worst_day = 0;               ///< from 0; the first of the worst ones
  std::uint32_t worst_minutes = 0;           ///< on that day
  std::optional<double> likely = {};         ///< minutes in the year by the shares of months
  bool over_year = false, over_day = false;  ///< more than the limits

  double hours() const { return minutes / 60.0; }
};

/// Sums the flicker of a dwelling, or that of one turbine there: a minute counts once, however many turbines and
/// facades it is about.
FlickerSum flicker_sum(const DwellingsSurvey& survey, const Dwelling& dwelling,
                       const std::optional<std::size_t>& turbine = {});

/// Merges the runs of a dwelling's facades, of all turbines or of one. Days end runs.
std::vector<FlickerRun> flicker_runs(const Dwelling& dwelling, const std::optional<std::size_t>& turbine = {});

/// The bare ground, what stands on it, and the same with woods that are seen through, in leaf and in winter.
enum class SightSurface : std::uint8_t { kBare, kScreened, kSummer, kWinter };

/// Sums up what a facade sees of the turbines before it; nothing where none is, or nothing was looked at.
std::optional<SightSummary> view_of(const DwellingsSurvey& survey, const DwellingFacade& facade, SightSurface surface);
/// Does so for a dwelling: a turbine is seen where one of the facades sees it, as much as the best of them does.
std::optional<SightSummary> view_of(const DwellingsSurvey& survey, const Dwelling& dwelling, SightSurface surface);

/// Surveys the dwellings. Throws InputError where the request makes no sense, the sun's place is not known there or in
/// that year, no turbine has ground, one stands within a building, no dwelling is within reach, or the memory does not
/// hold the ground between a dwelling and one turbine; Cancelled, CorruptStore, FileError.
DwellingsSurvey survey_dwellings(const Store& store, DwellingsRequest request, Progress& progress);

/// The JSON document that `itin dwellings --json` prints, without the call and its outputs.
std::string json_of(const DwellingsSurvey& survey);

struct DwellingsFileOptions {
  /// Returns the text of dwellings.json, given the other files; empty: what json_of() returns, and the files.
  std::function<std::string(const std::vector<PlanFile>& files)> manifest = {};
  bool overwrite = false;
  /// A sheet for each dwelling, on these papers as PDF and PNG: a map, what its facades see, a calendar of its flicker.
  /// The project and the date are those of dwellings.png as well, whether there are papers or none.
  profile::SheetChoice sheets = {};
  /// Only for these dwellings, by their names, ids or rows in dwellings.csv; empty: for all.
  std::vector<std::string> sheets_of = {};
};

/// Writes dwellings.csv, facades.csv, flicker.csv, calendar.csv, calendar.png, dwellings.gpkg, dwellings.png and the
/// sheets into a folder, which appears complete or not at all, and returns what is in it besides dwellings.json. Files
/// of an earlier survey there are replaced if `overwrite`; foreign ones are kept. Throws InputError where no dwelling
/// has a name of `sheets_of`, and for a scale of sheets that is too large; FileError, Cancelled.
std::vector<PlanFile> write_dwellings(const std::string& folder, const Store& store, const DwellingsSurvey& survey,
                                      const DwellingsFileOptions& options, Progress& progress);

/// Checks that such a folder may be written at `path`. Throws FileError.
void require_dwellings_folder(const std::string& path, bool overwrite);

}  // namespace itin::viewshed
