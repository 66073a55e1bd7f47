// The parts of a sheet of paper: its edges, the map's frame and the panel beside it. Lengths are points, 1/72 inch.
#pragma once

#include <itin/geometry.hpp>
#include <profile/map_sheet.hpp>

namespace itin::profile {

inline constexpr double kPointsPerMillimetre = 72 / 25.4;

struct Paper {
  double width, height;
  double type;  ///< factor for sizes of letters and symbols: A1 is read from farther away
  Box frame;    ///< about the map
  Box panel;
};

Paper paper_of(PaperSize size);

/// The ground, in metres, that a frame shows at 1 : scale, with the middle of `area` in its middle.
Box ground_in(const Box& frame, const Box& area, double scale);

}  // namespace itin::profile
