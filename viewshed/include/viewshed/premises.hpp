// Which buildings which masts can serve, at which height on which wall or roof, and what stops the rest; and the files
// that tell it.
//
//   viewshed::PremisesRequest wanted;
//   wanted.masts.places = {{.name = "church", .position = {321800, 4297750}, .height = 30}};
//   wanted.frequency_ghz = 26, wanted.earth = Earth::effective_earth(4.0 / 3);
//   const viewshed::PremisesSurvey survey = viewshed::survey_premises(store, wanted, progress);
//   for (const viewshed::Premises& house : survey.premises)
//     if (house.best) std::cout << house.name << ": " << house.best_mounting().height_m << " m\n";
//   viewshed::write_premises("premises", store, survey, {}, progress);
//
// An antenna may be mounted before a wall, at the height of each storey, or on a pole on the roof. Each such place is
// judged by exact lines of sight over the full surface with the chosen themes: the building's own walls, roof and
// parapets are in the way like all others. A place before a wall stands on the bare ground there and one on a roof on
// the surface, as the ends of `itin los` do, which gives the same verdicts. Places are whole millimetres.
//
// Positions are in the store's CRS, lengths in metres. InputError and warnings name fields between backticks.
#pragma once

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
#include <viewshed/site_coverage.hpp>
#include <viewshed/site_plan.hpp>

namespace itin::viewshed {

struct PremisesRequest : AntennaPlaces {
  SitePlaces masts = {};
  double mast_height = 20;        ///< the height of masts that have none of their own
  bool masts_on_surface = false;  ///< masts stand on the themes, where these are higher
  double radius = 1000;           ///< how far a mast serves, horizontally
  /// How far before its walls the street of a building lies. Where it is given, each place on the roofs is told: its
  /// least pole that a mast serves, and the least that sees the street past the building's own roof.
  std::optional<double> setback = {};
  /// With a frequency, GHz, a place is served only if the link leaves `fresnel` of the first Fresnel zone's radius
  /// clear.
  std::optional<double> frequency_ghz = {};
  double fresnel = 0.6;
  Earth earth = {};
  /// What stands on the ground. The premises are its buildings and terraces.
  ThemeChoice themes = ThemeChoice::all();
  NoData nodata = NoData::kUnknown;
  /// Changes the speed, never the result. Of the ground at most this much is in memory at once, or 64 MB.
  std::uint64_t memory_bytes = std::uint64_t{1} << 30;
};

enum class MountedOn : std::uint8_t { kWall, kRoof };

/// An antenna at a place of a building.
struct Mounting {
  MountedOn on = MountedOn::kWall;
  Point2 position;
  double base_m = 0;      ///< elevation of what the height is above: of the bare ground before a wall, or of the roof
  double height_m = 0;    ///< above that
  double distance_m = 0;  ///< horizontal distance to the mast

  double elevation_m() const { return base_m + height_m; }
};

/// What is in the way of a link, as seen from the building.
struct LinkBlocker {
  std::uint16_t theme = 0;    ///< from 1; 0: terrain
  std::int64_t feature = -1;  ///< as FeatureAt::number; -1: none
  std::string name;           ///< the feature's title; empty for terrain
  Point2 position;            ///< where it begins to be in the way
  bool own = false;           ///< it is the building itself
};

/// What a mast within reach is to a building.
struct PremisesLink {
  std::size_t mast = 0;
  /// kVisible: it serves the building. kZoneCut: no place with a clear zone, but the last one tried is in sight.
  /// kUndecided: ground without data alone leaves it open.
  Verdict verdict = Verdict::kHidden;
  std::optional<Mounting> wall;  ///< served from the least height on a wall; of several the nearest to the mast
  std::optional<Mounting> roof;  ///< served with the least pole; of several the nearest to the mast
  /// Where the building was tried in vain: the highest place at its greatest height, of several the nearest to the
  /// mast.
  std::optional<Mounting> tried;
  std::optional<LinkBlocker> blocker;  ///< what is in the way of `tried`; nothing where no ground is known to be
};

/// A stretch of a wall, and the antenna before its middle.
struct WallPlace {
  std::vector<Point3> stretch;      ///< along the foot, two points or more; the wall looks to the left of it
  Point2 position;                  ///< where the antenna is
  double ground_m = 0;              ///< elevation of the bare ground under the antenna
  double least_m = 0;               ///< where the wall begins above that: above 0 where it rises from a lower roof
  double most_m = 0;                ///< where the wall ends
  std::optional<std::size_t> mast;  ///< the mast that serves it from the least height; of several the nearest
  double height_m = 0;              ///< that height
  double distance_m = 0;            ///< horizontal distance to that mast
  bool undecided = false;           ///< not served, but ground without data alone leaves that open
};

/// How a place on a roof sees the street.
struct StreetSight {
  Point3 street;      ///< a place of the street before the nearest wall, on the ground
  double pole_m = 0;  ///< the least pole that sees it
  /// What hides the street from lower poles: a parapet, a ridge, the eaves, or what stands before the wall.
  struct Edge {
    Point3 position;
    std::uint16_t theme = 0;  ///< from 1; 0: terrain
  };
  std::optional<Edge> edge;  ///< nothing where the roof itself sees the street
};

/// A place on a roof, where poles stand.
struct RoofPlace {
  Point2 position;
  double roof_m = 0;                       ///< its elevation
  std::optional<std::size_t> mast = {};    ///< the mast that serves it with the least pole; of several the nearest
  double height_m = 0;                     ///< that pole
  double distance_m = 0;                   ///< horizontal distance to that mast
  std::optional<StreetSight> street = {};  ///< nothing where no wall of the building stands on open ground
};

struct Premises {
  std::uint16_t theme = 0;                ///< from 1
  std::int64_t feature = 0;               ///< as FeatureAt::number
  std::string name, id;                   ///< as FeatureAt has them
  std::vector<std::vector<Point2>> foot;  ///< closed rings
  std::size_t roof_places = 0;            ///< how many places its roof has
  std::vector<RoofPlace> roof;            ///< these, where the request has a setback
  std::vector<WallPlace> walls;
  std::vector<PremisesLink> links;  ///< one for each mast that has one of the places within its radius, in their order
  /// The link that serves it best: from a wall before from the roof, from the least height, the shortest.
  std::optional<std::size_t> best;

  const Mounting& best_mounting() const { return links[*best].wall ? *links[*best].wall : *links[*best].roof; }
  std::size_t masts_serving() const;
  /// kVisible: served. kUndecided: some mast may serve it. kOutside: no mast is within reach.
  Verdict verdict() const;
  /// The link to tell of where nothing serves it: the undecided one or else the nearest; nothing without a mast in
  /// reach.
  const PremisesLink* nearest_miss() const;
};

struct PremisesCounts {
  std::size_t all = 0, on_walls = 0, on_roofs = 0;  ///< served from a wall, and from the roof alone
  std::size_t undecided = 0, unserved = 0, out_of_reach = 0;

  std::size_t served() const { return on_walls + on_roofs; }
};

struct PremisesSurvey {
  PremisesRequest request;
  std::vector<SitePosition> masts;
  std::vector<Premises> premises;  ///< those with a wall or a roof
  StoreMetadata metadata;
  std::vector<std::string> warnings;  ///< a line each
  Statistics statistics;

  PremisesCounts counts() const;
};

/// Surveys the buildings. Throws InputError where the request makes no sense, the chosen themes have no building that
/// stands on the ground, a mast has no ground or ends within a building, no building is within reach of a mast, or the
/// memory does not hold the ground between a building and one mast; Cancelled, CorruptStore, FileError.
PremisesSurvey survey_premises(const Store& store, PremisesRequest request, Progress& progress);

/// The JSON document that `itin premises --json` prints, without the call and its outputs.
std::string json_of(const PremisesSurvey& survey);

struct PremisesFileOptions {
  /// Returns the text of premises.json, given the other files; empty: what json_of() returns, and the files.
  std::function<std::string(const std::vector<PlanFile>& files)> manifest = {};
  bool overwrite = false;
  profile::SheetChoice sheets = {};  ///< premises.png has its project and its date
};

/// Writes premises.csv, links.csv, premises.gpkg, premises.png, facades.glb and, with a setback, roofs.csv into a
/// folder, which appears complete or not at all, and returns what is in it besides premises.json. Files of an earlier
/// survey there are replaced if `overwrite`; foreign ones are kept. Throws FileError, Cancelled.
std::vector<PlanFile> write_premises(const std::string& folder, const Store& store, const PremisesSurvey& survey,
                                     const PremisesFileOptions& options, Progress& progress);

/// Checks that such a folder may be written at `path`. Throws FileError.
void require_premises_folder(const std::string& path, bool overwrite);

}  // namespace itin::viewshed
