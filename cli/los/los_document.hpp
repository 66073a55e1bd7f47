// The `los` document of the contract, from a report.
#pragma once

#include <optional>

#include <profile/los.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// One end of the line, as far as it is known: a profile from a file has no positions.
struct LosEnd {
  double ground_m = 0, height_m = 0;
  double elevation_angle_deg = 0;   ///< of the other end
  std::optional<double> surface_m;  ///< of a store: what stands on the ground included
  bool on_surface = false;          ///< whether height_m counts from that
  double elevation_m() const { return (on_surface ? *surface_m : ground_m) + height_m; }
  struct Site {
    Point2 position;
    Point2 lon_lat;
    double azimuth_grid_deg = 0, azimuth_true_deg = 0;  ///< towards the other end
  };
  std::optional<Site> site;
};
Document end_document(const LosEnd& end);

/// `distance_m`, `verdict`, `clearance_m`, `critical`, `obstructions`, `criteria`, `required_heights`, `radio`,
/// `visible_height`. Positions are null in a profile without any.
Document los_document(const profile::LosReport& report);

}  // namespace itin::cli
