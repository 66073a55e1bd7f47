#include "drawing/map_overlay.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/precondition.hpp>
#include <itin/sort_unique.hpp>
#include <viewshed/area_text.hpp>
#include <viewshed/documents.hpp>
#include <viewshed/result.hpp>

#include "line/infinity.hpp"
#include "modes/feature_names.hpp"
#include "request/request.hpp"
#include "turbines/value_bands.hpp"

namespace itin::viewshed {

namespace {

constexpr double kOpacity = 0.55;  ///< how opaque what is seen is drawn
constexpr int kSteps = 5;
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The colours of observers and features, without amber, which is for the undecided.
constexpr std::array<Rgba, 7> kPalette{
    {{0, 114, 178}, {73, 0, 146}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {213, 94, 0}, {240, 228, 66}}};

/// The colour of targets below the ground on maps of heights.
constexpr Rgba kBuriedColour{110, 75, 45};

/// How cells are drawn whose value is not known, in modes that give every other cell one.
constexpr Tint kUnknownTint{kUndecidedGrey, kOpacity};

/// The opacity of step i of n, weak to strong.
double opacity_of(int i, int n) {
  return n == 1 ? kOpacity : 0.25 + 0.6 * i / (n - 1);
}

/// The least of 1, 2 or 5 times a power of ten that is at least v.
double round_step(double v) {
  const double decade = std::pow(10, std::floor(std::log10(v)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * decade >= v * (1 - 1e-9)) return step * decade;
  return 10 * decade;
}

std::string range_text(double from, double to) {
  return fmt::format("{:.10g}–{:.10g}", from, to);
}

struct Extremes {
  double least = kInfinity;
  double most = -kInfinity;
  bool empty() const { return least > most; }
};

Extremes extremes_of(const std::vector<float>& values) {
  Extremes e;
  for (const float v : values) {
    if (!std::isfinite(v)) continue;
    e.least = std::min(e.least, static_cast<double>(v));
    e.most = std::max(e.most, static_cast<double>(v));
  }
  return e;
}

/// The values that are kept, ascending. Where there are many, these are a sample of about a million, which tells as
/// much.
template <class Keep>
std::vector<float> sorted_sample(const std::vector<float>& values, const Keep& keep) {
  std::vector<float> sample;
  const std::size_t step = values.size() / 1000000 + 1;
  for (std::size_t i = 0; i < values.size(); i += step)
    if (keep(values[i])) sample.push_back(values[i]);
  std::sort(sample.begin(), sample.end());
  return sample;
}

}  // namespace

MapOverlay::MapOverlay(const Result& result, const MapOptions& options) : result_(result) {
  make_scale(options);
  make_keys(options);
}

std::optional<Tint> MapOverlay::at(std::size_t cell) const {
  const Verdict seen = result_.visible[cell];
  if (seen == Verdict::kOutside) return std::nullopt;
  if (lacks_values_ && std::isnan(value(cell))) return kUnknownTint;
  if (seen == Verdict::kUndecided) return Tint{kUndecidedColour, kOpacity};
  if (seen == Verdict::kZoneCut) return Tint{kZoneCutColour, kOpacity};
  if (steps_.empty()) return Tint{kSeenColour, seen == Verdict::kVisible ? kOpacity : 0};
  const std::optional<std::size_t> step = step_of(cell);
  return step ? steps_[*step].tint : Tint{};
}

/// Returns the step of the scale that a cell shows, if any. Precondition: there is a scale.
std::optional<std::size_t> MapOverlay::step_of(std::size_t cell) const {
  ITIN_PRECONDITION(!steps_.empty());
  if (is_buried(cell)) return steps_.size() - 1;
  const double v = value(cell);
  if (std::isnan(v)) return std::nullopt;
  const auto step = std::lower_bound(most_.begin(), most_.end(), v);
  return std::min(static_cast<std::size_t>(step - most_.begin()), steps_.size() - 1);
}

/// Returns the tints of the steps that cells of a verdict show, in the scale's order.
std::vector<Tint> MapOverlay::tints_of(Verdict verdict) const {
  std::vector<bool> shown(steps_.size());
  for (std::size_t i = 0; i < result_.visible.size(); ++i)
    if (result_.visible[i] == verdict)
      if (const auto step = step_of(i)) shown[*step] = true;
  std::vector<Tint> tints;
  for (std::size_t i = 0; i < steps_.size(); ++i)
    if (shown[i]) tints.push_back(steps_[i].tint);
  return tints;
}

double MapOverlay::value(std::size_t cell) const {
  const auto positive = [](double v) { return v > 0 ? v : kNoValue; };
  switch (result_.request.mode) {
    case Mode::kCount:
      return positive(result_.get<Counts>().count[cell]);
    case Mode::kWhich: {
      const auto& words = result_.get<ObserverSets>().words;
      int count = 0;
      for (std::size_t i = cell; i < words.size(); i += result_.grid.cell_count()) count += std::popcount(words[i]);
      return positive(count);
    }
    case Mode::kAngle:
      return result_.get<Angles>().angle_deg[cell];
    case Mode::kNearest: {
      const auto& nearest = result_.get<NearestObservers>();
      return result_.request.observers.size() <= kPalette.size() ? positive(nearest.number[cell])
                                                                 : nearest.distance_m[cell];
    }
    case Mode::kBlocker: {
      const std::uint32_t theme = result_.get<Blockers>().theme[cell];
      return result_.visible[cell] == Verdict::kVisible ? 0 : theme == kNoBlocker ? kNoValue : blocker_value(theme);
    }
    case Mode::kHeight:
      return result_.get<LeastHeights>().height_m[cell];
    case Mode::kProbability:
      return result_.get<Probabilities>().probability[cell];
    case Mode::kLoss:
      return result_.get<Losses>().diffraction_db[cell];
    case Mode::kLevel:
      return result_.get<Levels>().level_dbm[cell];
    case Mode::kVisible:
    case Mode::kFresnel:
      break;
  }
  return kNoValue;
}

/// Tells whether a map of heights has a target below the ground in the cell: such a target is hidden, though the
/// ground is seen from height 0 on or from above.
bool MapOverlay::is_buried(std::size_t cell) const {
  const Request& request = result_.request;
  return request.mode == Mode::kHeight && request.target_absolute && result_.visible[cell] == Verdict::kHidden &&
         result_.get<LeastHeights>().height_m[cell] == 0;
}

/// The theme's number on the scale of blockers.
double MapOverlay::blocker_value(std::uint32_t theme) const {
  const auto known = std::find(blockers_.begin(), blockers_.end(), theme);
  return known == blockers_.end() ? kNoValue : static_cast<double>(known - blockers_.begin() + 1);
}

void MapOverlay::add_step(double most, Tint tint, std::string text) {
  most_.push_back(most);
  steps_.push_back({tint, std::move(text)});
}

void MapOverlay::make_scale(const MapOptions& options) {
  switch (result_.request.mode) {
    case Mode::kCount:
    case Mode::kWhich:
      return scale_counts(options.counts);
    case Mode::kAngle:
      return scale_angles();
    case Mode::kNearest:
      return result_.request.observers.size() <= kPalette.size() ? scale_observers() : scale_distances();
    case Mode::kBlocker:
      return scale_blockers();
    case Mode::kHeight:
      return scale_heights();
    case Mode::kProbability:
      return scale_probabilities();
    case Mode::kLoss:
      return scale_losses();
    case Mode::kLevel:
      return scale_levels();
    case Mode::kVisible:
    case Mode::kFresnel:
      return;
  }
}

void MapOverlay::scale_counts(const std::string& title) {
  title_ = title;
  int most = 1;
  for (std::size_t i = 0; i < result_.visible.size(); ++i)
    if (const double v = result_.visible[i] == Verdict::kVisible ? value(i) : 0; v > most) most = static_cast<int>(v);
  const int steps = std::min(most, kSteps);
  for (int i = 0; i < steps; ++i) {
    const int from = most * i / steps + 1, to = most * (i + 1) / steps;
    add_step(to, {kSeenColour, opacity_of(i, steps)},
             from == to ? fmt::format("{}", from) : fmt::format("{}–{}", from, to));
  }
}

void MapOverlay::scale_angles() {
  title_ = "Elevation angle, degrees";
  // An observer's own place lies straight below it.
  const std::vector<float> angles =
      sorted_sample(result_.get<Angles>().angle_deg, [](float degrees) { return std::abs(degrees) < 90; });
  if (angles.empty()) return;
  const auto at = [&](double share) {
    return static_cast<double>(angles[static_cast<std::size_t>(share * static_cast<double>(angles.size() - 1))]);
  };
  // Limits are round angles that part the cells into about equal numbers: most lie near the horizon.
  const double width = round_step(std::max((at(0.9) - at(0.1)) / (2 * kSteps), 0.01));
  std::vector<double> limits;
  for (int i = 1; i < kSteps; ++i) {
    const double limit = std::round(at(static_cast<double>(i) / kSteps) / width) * width + 0.0;  // no -0
    if (limits.empty() || limit > limits.back() + width / 2) limits.push_back(limit);
  }
  const int steps = static_cast<int>(limits.size()) + 1;
  for (int i = 0; i < steps; ++i) {
    const auto limit = [&](int l) { return fmt::format("{:.6g}", limits[static_cast<std::size_t>(l)]); };
    add_step(i + 1 < steps ? limits[static_cast<std::size_t>(i)] : kInfinity, {kSeenColour, opacity_of(i, steps)},
             i == 0           ? "up to " + limit(0)
             : i + 1 == steps ? "> " + limit(i - 1)
                              : limit(i - 1) + " to " + limit(i));
  }
}

void MapOverlay::scale_observers() {
  title_ = "Nearest visible observer";
  for (std::size_t i = 0; i < result_.request.observers.size(); ++i) {
    const std::string& name = result_.request.observers[i].name;
    add_step(static_cast<double>(i + 1), {kPalette[i], kOpacity}, name.empty() ? fmt::format("{}", i + 1) : name);
  }
}

void MapOverlay::scale_distances() {
  title_ = "Distance of the nearest visible observer, metres";
  const Extremes e = extremes_of(result_.get<NearestObservers>().distance_m);
  if (e.empty()) return;
  const double width = round_step(std::max(e.most / kSteps, 1.0));
  const int steps = std::max(1, static_cast<int>(std::ceil(e.most / width)));
  for (int i = 0; i < steps; ++i)
    add_step((i + 1) * width, {kSeenColour, opacity_of(steps - 1 - i, steps)}, range_text(i * width, (i + 1) * width));
}

void MapOverlay::scale_blockers() {
  title_ = "Visible, or hidden by";
  blockers_ = result_.get<Blockers>().theme;
  sort_unique(blockers_);
  std::erase(blockers_, kNoBlocker);
  add_step(0, {kSeenColour, kOpacity}, "visible");
  for (std::size_t i = 0; i < blockers_.size(); ++i) {
    const std::uint32_t theme = blockers_[i];
    // Blue is for what is seen.
    add_step(static_cast<double>(i + 1), {kPalette[1 + i % (kPalette.size() - 1)], theme == 0 ? 0.2 : kOpacity},
             blocker_name(result_, theme));
  }
  // Cells that their own ground hides have no value: the relief alone shows.
  const std::vector<std::uint32_t>& themes = result_.get<Blockers>().theme;
  for (std::size_t i = 0; i < themes.size(); ++i)
    if (result_.visible[i] == Verdict::kHidden && themes[i] == kNoBlocker) return add_step(kInfinity, {}, "own ground");
}

void MapOverlay::scale_heights() {
  title_ =
      fmt::format("Least height above {}, metres", result_.request.targets_on_surface ? "the surface" : "the ground");
  constexpr int kBands = kMastHeightLimits.size() + 2;
  int band = kBands;
  const auto add = [&](double most, std::string text) {
    --band;
    add_step(most, {kSeenColour, 0.08 + 0.77 * band / (kBands - 1)}, std::move(text));
  };
  add(0, "0");
  double from = 0;
  for (const double limit : kMastHeightLimits) {
    add(limit, range_text(from, limit));
    from = limit;
  }
  add(kInfinity, fmt::format("> {:.10g}", from));
  for (std::size_t i = 0; i < result_.visible.size(); ++i)
    if (is_buried(i)) return add_step(kInfinity, {kBuriedColour, kOpacity}, "buried");
}

void MapOverlay::scale_probabilities() {
  title_ = "Probability of being visible, percent";
  int from = 0;
  for (const int percent : {5, 25, 50, 75, 95, 100}) {
    add_step(percent / 100.0, {kSeenColour, percent == 5 ? 0 : 0.85 * (percent - 5) / 95}, range_text(from, percent));
    from = percent;
  }
}

void MapOverlay::scale_losses() {
  title_ = "Diffraction loss, dB";
  double from = 0;
  for (const ValueBand& band : loss_bands()) {
    const bool last = !std::isfinite(band.to);
    add_step(band.to, {band.colour, kOpacity},
             band.to == 0 ? "0"
             : last       ? fmt::format("> {:.10g}", from)
                          : range_text(from, band.to));
    from = band.to;
  }
}

void MapOverlay::scale_levels() {
  const std::optional<double>& sensitivity = result_.request.budget.sensitivity_dbm;
  title_ = sensitivity ? fmt::format("Level over a sensitivity of {:g} dBm", *sensitivity) : "Received level";
  for (const ValueBand& band : level_bands(result_.request)) add_step(band.to, {band.colour, kOpacity}, band.label);
}

/// Adds a key with the cells' share of those with data in view.
void MapOverlay::add_key(std::vector<Tint> tints, const std::string& what, std::uint64_t cells) {
  const double decided = static_cast<double>(std::max<std::uint64_t>(1, result_.cells.in_view()));
  keys_.push_back({std::move(tints), fmt::format("{}: {} ({:.1f} %)", what, area_of(cells),
                                                 100.0 * static_cast<double>(cells) / decided)});
}

/// Adds a key with the class's share as the options give it, if they do.
void MapOverlay::add_key(std::vector<Tint> tints, const std::string& what, std::uint64_t cells,
                         const MapOptions& options, double ClassShares::*share) {
  if (!options.shares) return add_key(std::move(tints), what, cells);
  keys_.push_back({std::move(tints), fmt::format("{}: {:.1f} % of {}, and {}", what, *options.shares.*share,
                                                 options.shares->of, area_of(cells))});
}

std::string MapOverlay::area_of(std::uint64_t cells) const {
  const double cell_area = result_.grid.cell_area();
  return part_text(static_cast<double>(cells) * cell_area, static_cast<double>(result_.cells.in_view()) * cell_area);
}

void MapOverlay::make_keys(const MapOptions& options) {
  const CellCounts& cells = result_.cells;
  if (result_.request.mode == Mode::kLevel) add_margin_keys();
  if (!studies_paths(result_.request)) add_verdict_keys(options);
  // Undecided cells are among those without a value.
  const std::optional<CellsWithoutValue> without = cells_without_value(result_);
  lacks_values_ = without && without->cells > 0;
  if (lacks_values_) add_key({kUnknownTint}, fmt::format("No {} known", without->value), without->cells);
  if (!without && (cells.undecided > 0 || result_.certified))
    add_key({{kUndecidedColour, kOpacity}}, "Undecided", cells.undecided, options, &ClassShares::undecided);
}

void MapOverlay::add_margin_keys() {
  for (const CellsWithMargin& with : cells_with_margins(result_)) {
    std::vector<Tint> tints;
    for (std::size_t i = with.band; i < steps_.size(); ++i) tints.push_back(steps_[i].tint);
    add_key(
        std::move(tints),
        with.margin_db == 0 ? "At or above the sensitivity" : fmt::format("Margin of {:g} dB or more", with.margin_db),
        with.cells);
  }
}

void MapOverlay::add_verdict_keys(const MapOptions& options) {
  const CellCounts& cells = result_.cells;
  const Mode mode = result_.request.mode;
  // The steps of this mode show what is seen and what is hidden alike.
  if (mode == Mode::kProbability) return;
  std::vector<Tint> seen, hidden;
  if (mode == Mode::kHeight) {
    seen = tints_of(Verdict::kVisible), hidden = tints_of(Verdict::kHidden);
  } else {
    // The first step of blockers is what is seen, and the others are what is hidden.
    for (const Step& step : steps_) (mode == Mode::kBlocker && !seen.empty() ? hidden : seen).push_back(step.tint);
  }
  if (seen.empty()) seen.push_back({kSeenColour, kOpacity});
  const bool zones = mode == Mode::kFresnel;
  add_key(std::move(seen),
          result_.certified ? "Certainly visible"
          : zones           ? fmt::format("In sight, {:g} F1 clear", result_.request.fresnel.fraction)
                            : options.seen,
          cells.visible, options, &ClassShares::seen);
  if (zones) add_key({{kZoneCutColour, kOpacity}}, "In sight, zone cut", cells.zone_cut);
  add_key(std::move(hidden), result_.certified ? "Certainly hidden" : options.unseen, cells.hidden, options,
          &ClassShares::unseen);
}

}  // namespace itin::viewshed
