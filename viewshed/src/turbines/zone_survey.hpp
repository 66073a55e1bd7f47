// Casts the sight lines of a zone of theoretical visibility: every eye of a raster to every turbine in its reach.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <viewshed/turbine_view.hpp>
#include <viewshed/turbines.hpp>

#include "line/cell_tiles.hpp"
#include "progress/stage.hpp"
#include "scene/exact_scene.hpp"
#include "scene/sweep/radial_sweep.hpp"
#include "turbines/turbine_shadows.hpp"

namespace itin::viewshed {

class ZoneSurvey {
 public:
  /// Prepares the survey. `zone` has its request, grid and ground; eyes stand on `ground`, whose grid is the zone's.
  /// Both must outlive the survey.
  ZoneSurvey(const ExactScene& ground, const Zone& zone);

  /// The surface that hides, and the shadows of voids behind which each turbine is hidden or undecided.
  struct Screen {
    const RadialSweep& sweep;
    const TurbineShadows& shadows;
    bool open_alone = false;  ///< lines whose bits the result's `turbines` does not have yet are known to be hidden
  };
  /// Enters what is seen from the cells of these tiles, each a step. Returns the number of lines that were cast.
  std::uint64_t run(const Screen& screen, std::span<const std::size_t> tiles, Visibility& result, Stage& stage) const;

 private:
  struct Axis {
    double x = 0, y = 0;       ///< grid units
    double base = 0, tip = 0;  ///< elevation, grid units
    double hub = 0;            ///< -infinity where the hub is not known
    Point2 position;
    double radius_squared = 0;  ///< metres squared
  };
  struct TileSightings;

  /// Views of the turbines over a surface.
  using Views = std::vector<std::optional<RadialSweep::View>>;
  Views views_over(const RadialSweep& sweep) const;
  /// `sums` are the tile's part of the visible heights; empty where the request has no weights.
  std::uint64_t decide(std::size_t tile, const Screen& screen, const Views& views, Visibility& result,
                       std::vector<double>& sums) const;
  void add_sums(const std::vector<std::vector<double>>& of_tiles, Visibility& result) const;
  bool in_reach(const Axis& axis, const Tile& tile) const;
  bool in_study_area(RasterGrid::Cell place) const;
  void observe(std::size_t turbine, const Screen& screen, const RadialSweep::View& view, TileSightings& work) const;
  void take_open_lines(std::size_t turbine, const Visibility& open, TileSightings& work) const;
  void record(std::size_t turbine, std::size_t cell, double distance, double least, TileSightings& work) const;
  void store(const TileSightings& work, Visibility& result) const;
  void store_horizon(const TileSightings& work, std::size_t from_cell, std::size_t to_cell, Point2 eye,
                     Visibility& result, std::vector<Arc>& arcs) const;

  const ExactScene& ground_;
  const Zone& zone_;
  std::vector<Axis> axes_;
  std::vector<Turbine> proposed_;  ///< the turbines of the study area, where these are not all; otherwise none
};

}  // namespace itin::viewshed
