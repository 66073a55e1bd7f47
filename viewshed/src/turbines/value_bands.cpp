#include "turbines/value_bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <itin/markup.hpp>

#include "line/infinity.hpp"

namespace itin::viewshed {

namespace {

// Colours of classes without an order, which are told apart over a grey base map with every kind of colour blindness
// (after Okabe and Ito).
constexpr std::array<Rgba, 8> kDistinct{{{240, 228, 66},
                                         {86, 180, 233},
                                         {0, 158, 115},
                                         {0, 114, 178},
                                         {230, 159, 0},
                                         {213, 94, 0},
                                         {204, 121, 167},
                                         {117, 30, 90}}};

ValueBand none() {
  return {0, kNoneSeen, kTransparent};
}

/// The colour of levels that are not enough.
constexpr Rgba kTooWeak{225, 225, 225};

/// Returns the colour of class i of n in an order: from pale yellow over green to dark blue (after ColorBrewer). A
/// single class is blue.
Rgba darkening_colour(std::size_t i, std::size_t n) {
  constexpr std::array<Rgba, 4> kStops{{{237, 248, 177}, {127, 205, 187}, {44, 127, 184}, {8, 29, 88}}};
  const double at = n < 2 ? 2 : static_cast<double>(i) / static_cast<double>(n - 1) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const Rgba &a = kStops[stop], &b = kStops[stop + 1];
  const auto mixed = [&](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * (at - static_cast<double>(stop))));
  };
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

/// Colours the bands above the first, which is of nothing, in their order.
void colour_bands(std::vector<ValueBand>& bands) {
  for (std::size_t i = 1; i < bands.size(); ++i) bands[i].colour = darkening_colour(i - 1, bands.size() - 1);
}

/// Returns the colour after so many golden angles on the circle of hues.
Rgba hue_after(std::size_t turn) {
  const double hue = std::fmod(static_cast<double>(turn) * 0.61803398875, 1.0) * 6;
  const auto channel = [&](double shift) {
    const double d = std::abs(std::fmod(hue + shift, 6.0) - 3) - 1;
    return static_cast<std::uint8_t>(60 + 160 * std::clamp(d, 0.0, 1.0));
  };
  return {channel(0), channel(4), channel(2)};
}

/// Tells whether a colour may be taken for one of kDistinct, by the distance of their red, green and blue.
bool is_near_a_distinct_one(const Rgba& colour) {
  constexpr double kApart = 70;
  return std::any_of(kDistinct.begin(), kDistinct.end(), [&](const Rgba& other) {
    return std::hypot(colour.red - other.red, colour.green - other.green, colour.blue - other.blue) < kApart;
  });
}

std::string style(const std::string& renderer) {
  return "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
         "<qgis version=\"3.22\" styleCategories=\"Symbology\">\n  <pipe>\n" +
         renderer + "  </pipe>\n  <blendMode>0</blendMode>\n</qgis>\n";
}

}  // namespace

std::vector<ValueBand> count_bands(std::size_t most, std::vector<std::size_t> limits) {
  constexpr std::size_t kMost = 7;
  const std::size_t width = std::max<std::size_t>(1, (most + kMost - 1) / kMost);
  if (limits.empty())
    for (std::size_t to = width; to < most; to += width) limits.push_back(to);
  limits.push_back(most);
  std::vector<ValueBand> bands{none()};
  std::size_t from = 1;
  for (const std::size_t limit : limits) {
    const std::size_t to = std::min(limit, most);
    if (to < from) continue;
    bands.push_back({static_cast<double>(to), from == to ? fmt::format("{}", from) : fmt::format("{} - {}", from, to)});
    from = to + 1;
  }
  colour_bands(bands);
  return bands;
}

std::vector<ValueBand> limit_bands(const std::vector<double>& limits, const std::string& unit) {
  std::vector<ValueBand> bands{none()};
  double from = 0;
  for (const double to : limits) {
    bands.push_back({to, fmt::format("{:g} - {:g} {}", from, to, unit)});
    from = to;
  }
  bands.push_back({kInfinity, fmt::format("above {:g} {}", from, unit)});
  colour_bands(bands);
  return bands;
}

std::vector<ValueBand> level_bands(const Request& request) {
  const std::optional<double>& sensitivity = request.budget.sensitivity_dbm;
  std::vector<double> limits(kLevelLimitsDbm.begin(), kLevelLimitsDbm.end());
  if (sensitivity) limits = request.margins_db.empty() ? std::vector<double>{0} : request.margins_db;
  const char* unit = sensitivity ? "dB" : "dBm";
  const char* of = sensitivity ? "margin " : "";
  std::vector<ValueBand> bands;
  const auto add_below = [&](double limit, std::string label) {
    const auto level = static_cast<float>(sensitivity.value_or(0) + limit);
    bands.push_back({std::nextafter(level, -kFloatInfinity), std::move(label)});
  };
  const bool served = sensitivity && limits.front() == 0;
  add_below(limits.front(),
            served ? "below the sensitivity" : fmt::format("{}below {:g} {}", of, limits.front(), unit));
  for (std::size_t i = 1; i < limits.size(); ++i)
    add_below(limits[i], fmt::format("{}{:g} to {:g} {}", of, limits[i - 1], limits[i], unit));
  bands.push_back({kInfinity, served && limits.size() == 1
                                  ? "at or above the sensitivity"
                                  : fmt::format("{}{:g} {} or more", of, limits.back(), unit)});
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i].colour = darkening_colour(i, bands.size());
  if (sensitivity) bands.front().colour = kTooWeak;
  return bands;
}

std::vector<ValueBand> loss_bands() {
  std::vector<ValueBand> bands = limit_bands({kLossLimitsDb.begin(), kLossLimitsDb.end()}, "dB");
  bands.front().label = "0 dB";
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i].colour = darkening_colour(bands.size() - 1 - i, bands.size());
  return bands;
}

std::vector<ValueBand> radar_bands() {
  std::vector<ValueBand> bands = limit_bands({25, 50, 75, 100, 150, 200, 500}, "m");
  bands.front().label = "the ground itself";
  bands.back() = {kRadarCeiling, fmt::format("500 - {:g} m", kRadarCeiling)};
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i].colour = darkening_colour(bands.size() - 1 - i, bands.size());
  return bands;
}

std::vector<ValueBand> share_bands() {
  constexpr double kPercent = 100;
  std::vector<ValueBand> bands = limit_bands({1, 2, 5, 10, 20, 50}, "% of the ground");
  for (ValueBand& band : bands) band.to /= kPercent;
  return bands;
}

std::size_t band_of(const std::vector<ValueBand>& bands, double value) {
  const auto band = std::find_if(bands.begin(), bands.end(), [&](const ValueBand& b) { return value <= b.to; });
  return static_cast<std::size_t>(std::min(band, bands.end() - 1) - bands.begin());
}

Rgba distinct_colour(std::size_t index) {
  if (index < kDistinct.size()) return kDistinct[index];
  std::size_t left = index - kDistinct.size();
  for (std::size_t turn = kDistinct.size();; ++turn) {
    const Rgba colour = hue_after(turn);
    if (!is_near_a_distinct_one(colour) && left-- == 0) return colour;
  }
}

std::string banded_style(const std::vector<ValueBand>& bands) {
  const double last = std::isfinite(bands.back().to) ? bands.back().to : bands[bands.size() - 2].to;
  std::string text = fmt::format(
      "    <rasterrenderer type=\"singlebandpseudocolor\" band=\"1\" opacity=\"0.7\" alphaBand=\"-1\" "
      "classificationMin=\"0\" classificationMax=\"{0:.10g}\" nodataColor=\"\">\n"
      "      <rasterTransparency/>\n      <rastershader>\n"
      "        <colorrampshader colorRampType=\"DISCRETE\" classificationMode=\"1\" clip=\"0\" minimumValue=\"0\" "
      "maximumValue=\"{0:.10g}\">\n",
      last);
  for (const ValueBand& b : bands)
    text += fmt::format("          <item value=\"{}\" label=\"{}\" color=\"#{:02x}{:02x}{:02x}\" alpha=\"{}\"/>\n",
                        std::isfinite(b.to) ? fmt::format("{:.10g}", b.to) : "inf", escaped_markup(b.label),
                        b.colour.red, b.colour.green, b.colour.blue, b.colour.alpha);
  return style(text + "        </colorrampshader>\n      </rastershader>\n    </rasterrenderer>\n");
}

std::string class_style(const std::vector<StyleClass>& classes) {
  std::string text =
      "    <rasterrenderer type=\"paletted\" band=\"1\" opacity=\"0.7\" alphaBand=\"-1\" nodataColor=\"\">\n"
      "      <rasterTransparency/>\n      <colorPalette>\n";
  for (const StyleClass& c : classes)
    text +=
        fmt::format("        <paletteEntry value=\"{}\" label=\"{}\" color=\"#{:02x}{:02x}{:02x}\" alpha=\"{}\"/>\n",
                    c.value, escaped_markup(c.label), c.colour.red, c.colour.green, c.colour.blue, c.colour.alpha);
  return style(text + "      </colorPalette>\n    </rasterrenderer>\n");
}

std::string class_style(const std::vector<RasterClass>& classes) {
  std::vector<StyleClass> style;
  for (const RasterClass& c : classes) style.push_back({c.value, c.name, c.colour});
  return class_style(style);
}

std::string commonest_style(std::vector<StyleClass> commonest_first) {
  constexpr std::size_t kMostColours = 24;
  commonest_first.resize(std::min(commonest_first.size(), kMostColours));
  for (std::size_t i = 0; i < commonest_first.size(); ++i) commonest_first[i].colour = distinct_colour(i);
  commonest_first.insert(commonest_first.begin(), {0, kNoneSeen, kTransparent});
  return class_style(commonest_first);
}

}  // namespace itin::viewshed
