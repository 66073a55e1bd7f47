// Bands of values, as maps and tables show them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <itin/raster.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

/// The name in tables and styles of cells from which nothing is seen.
inline constexpr const char* kNoneSeen = "none";
/// The name and colour of cells from which ground without data leaves open whether anything is seen. No band has this
/// colour.
inline constexpr const char* kUndecidedSeen = "undecided";
inline constexpr Rgba kUndecidedGrey{140, 140, 140};

/// The band of the values above the previous band's limit, up to this one's.
struct ValueBand {
  double to = 0;  ///< may be infinite
  std::string label;
  Rgba colour = {};
};

/// Returns a band for 0 (transparent), then bands for 1 to `most` up to these limits, the last one up to `most`.
/// Without limits there are at most seven bands of equal width.
std::vector<ValueBand> count_bands(std::size_t most, std::vector<std::size_t> limits = {});
/// Returns a band for 0 (transparent), then bands between the limits, the last one open. `unit` is as in "10 - 25 m".
std::vector<ValueBand> limit_bands(const std::vector<double>& limits, const std::string& unit);
/// Limits of bands of diffraction losses, from slight to beyond use; dB.
inline constexpr std::array<double, 4> kLossLimitsDb{6, 15, 30, 50};
/// Returns the bands of diffraction losses, the least the darkest. A loss of 0 has a colour, too: only cells without a
/// loss have none.
std::vector<ValueBand> loss_bands();
/// Limits of bands of levels at a receiver whose sensitivity is not known; dBm.
inline constexpr std::array<double, 6> kLevelLimitsDbm{-100, -90, -80, -70, -60, -50};
/// Returns the bands of levels at a receiver, from the weakest on: by the margins over the sensitivity where the
/// request has one. A level at a limit is in the band above it.
std::vector<ValueBand> level_bands(const Request& request);
/// Limits of bands of least heights that are seen: those of usual masts; metres.
inline constexpr std::array<double, 5> kMastHeightLimits{5, 10, 20, 30, 50};
/// Heights above the ground up to which a radar's sight is told; metres.
inline constexpr double kRadarCeiling = 1000;
/// Returns the bands of least heights that a radar sees, the lowest the darkest. The first is of ground that it sees.
std::vector<ValueBand> radar_bands();
/// Returns the bands of shares of the ground, 0 to 1.
std::vector<ValueBand> share_bands();
/// Returns the band that holds a value: the first whose limit it does not exceed.
std::size_t band_of(const std::vector<ValueBand>& bands, double value);

/// Returns hues that are easily told apart, for classes without an order.
Rgba distinct_colour(std::size_t index);

/// Returns a QGIS layer style that draws a raster of values in these bands, or of classes.
std::string banded_style(const std::vector<ValueBand>& bands);
struct StyleClass {
  std::int64_t value = 0;
  std::string label;
  Rgba colour = {};
};
std::string class_style(const std::vector<StyleClass>& classes);
std::string class_style(const std::vector<RasterClass>& classes);
/// Returns a style of classes without colours: the first 24 get colours that are told apart, and 0, which is not among
/// them, is none.
std::string commonest_style(std::vector<StyleClass> commonest_first);

}  // namespace itin::viewshed
