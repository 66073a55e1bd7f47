// The parts of a sheet of paper or of a picture for a screen: its edges, the map's frame and the panel beside it.
// Lengths are points, 1/72 inch.
#pragma once

#include <algorithm>
#include <string>

#include <itin/geometry.hpp>
#include <profile/map_sheet.hpp>

namespace itin::profile {

inline constexpr double kPointsPerMillimetre = 72 / 25.4;
/// The resolution of sheets that are pictures: 200 dots per inch.
inline constexpr double kPixelsPerPointOfSheets = 200 / 72.0;

struct Paper {
  double width, height;
  double type;       ///< factor for sizes of letters and symbols: A1 is read from farther away
  std::string name;  ///< "A3"; empty for a picture, which has no scale of its own
  Box frame;         ///< about the map
  Box panel;

  /// Returns the size of letters that are so large on A3. None are smaller than can be read in print.
  double letters(double points) const { return std::max(kLeastLetters, points * type); }
  static constexpr double kLeastLetters = 6;
};

Paper paper_of(PaperSize size);
/// A picture whose frame has the shape of `area`, and as many pixels along its longer side. Its panel may be made
/// longer: see with_panel().
Paper picture_of(const Box& area, int pixels, double pixels_per_point);
/// Returns the picture with a panel of this height, if that is more than the frame's.
Paper with_panel(Paper picture, double height);

/// The largest usual scale at which a frame shows the area: 1 : 25,000 and the like.
double usual_scale_within(const Box& frame, const Box& area);
/// The scale at which a frame shows the sheet's area: that given, or the largest usual one. Throws InputError for a
/// given scale at which the area does not fit.
double scale_within(const Box& frame, const MapSheet& sheet);

/// The ground, in metres, that a frame shows at 1 : scale, with the middle of `area` in its middle.
Box ground_in(const Box& frame, const Box& area, double scale);

}  // namespace itin::profile
