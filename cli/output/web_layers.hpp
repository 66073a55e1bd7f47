// Draws layers of a map as parts of an SVG whose places are percentages of its size: pictures and lines are stretched
// with the SVG, marks and letters are not.
//
//   std::string svg = web_layer(frame, layer, WebPicture::kCells);
#pragma once

#include <string>

#include <itin/geometry.hpp>
#include <profile/map_sheet.hpp>

namespace itin::cli {

/// The pixels of a picture's longer side: of the ground's, and the most of cells'.
inline constexpr int kWebGroundPixels = 1000, kWebMostCells = 1200;

/// The format of cells. The ground becomes a JPEG, which is opaque; others become a PNG with alpha, whose edges stay
/// sharp.
enum class WebPicture { kGround, kCells };

/// Draws what a layer shows of a frame, without the labels of marks. Throws FileError where a picture cannot be made.
std::string web_layer(const Box& frame, const profile::SheetLayer& layer, WebPicture picture);

/// Writes a share from 0 to 1: "23.40%".
std::string web_percent(double share);

}  // namespace itin::cli
