#include <algorithm>
#include <functional>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/raster_in_parts.hpp>
#include <viewshed/result.hpp>
#include <viewshed/result_files.hpp>
#include <viewshed/visibility_index.hpp>

#include "files/verdict_classes.hpp"
#include "line/verdicts.hpp"
#include "request/request.hpp"

namespace itin::viewshed {

namespace {

std::string observers_text(const std::vector<Observer>& observers) {
  std::string text;
  for (const Observer& o : observers) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{:.12g},{:.12g},{:.12g}", o.position.x, o.position.y, o.height);
  }
  return text;
}

std::string text_of(double v) {
  return fmt::format("{:.12g}", v);
}
std::string text_of(const AngleRange& range) {
  return fmt::format("{:.12g},{:.12g}", range.from, range.to);
}

using Metadata = std::vector<std::pair<std::string, std::string>>;

/// Adds each observer's own value or, where it has none, the value for all: once where all are equal, and otherwise one
/// by one, `-` for none.
template <class Value>
void add_of_observers(const std::string& name, const Request& request, std::optional<Value> Observer::*own,
                      const std::optional<Value>& of_all, Metadata& items) {
  std::vector<std::string> texts;
  for (const Observer& observer : request.observers) {
    const std::optional<Value>& value = observer.*own ? observer.*own : of_all;
    texts.push_back(value ? text_of(*value) : "-");
  }
  if (std::adjacent_find(texts.begin(), texts.end(), std::not_equal_to<>()) == texts.end()) texts.resize(1);
  if (texts != std::vector<std::string>{"-"}) items.emplace_back(name, fmt::format("{}", fmt::join(texts, " ")));
}

void add_budget(const profile::BudgetQuery& budget, Metadata& items) {
  const auto add = [&](const char* name, const std::optional<double>& value) {
    if (value) items.emplace_back(name, text_of(*value));
  };
  add("power_dbm", budget.power_dbm);
  add("eirp_dbm", budget.eirp_dbm);
  add("gain1_dbi", budget.from_gain_dbi);
  add("gain2_dbi", budget.to_gain_dbi);
  add("feeder_loss1_db", budget.from_feeder_db);
  add("feeder_loss2_db", budget.to_feeder_db);
  add("sensitivity_dbm", budget.sensitivity_dbm);
  add("rain_rate_mm_h", budget.rain_rate_mm_h);
  add("antenna1_azimuth_deg", budget.from_antenna.azimuth_deg);
  add("antenna1_tilt_deg", budget.from_antenna.tilt_deg);
  add("antenna2_azimuth_deg", budget.to_antenna.azimuth_deg);
  add("antenna2_tilt_deg", budget.to_antenna.tilt_deg);
}

/// Adds what the observers' own antennas have, with a dash where one has nothing; nothing where none has.
void add_of_antennas(const char* name, const Request& r, std::optional<double> profile::AimedAntenna::*value,
                     Metadata& items) {
  std::vector<std::string> texts;
  for (const Observer& observer : r.observers)
    texts.push_back(observer.antenna.*value ? text_of(*(observer.antenna.*value)) : "-");
  if (std::any_of(texts.begin(), texts.end(), [](const std::string& text) { return text != "-"; }))
    items.emplace_back(name, fmt::format("{}", fmt::join(texts, " ")));
}

Metadata metadata_of(const Result& result) {
  const Request& r = result.request;
  Metadata items{{"observers", observers_text(r.observers)},
                 {"nodata_rule", nodata_text(r.nodata)},
                 {"refraction", r.earth.convention()},
                 {"cells", "decided at their centres"}};
  if (result.certified) items.emplace_back("decided_exactly", result.decided_exactly ? "yes" : "no");
  if (r.observers.front().absolute) items.emplace_back("observer_heights", "elevations");
  add_of_observers(r.target_absolute ? "target_elevation_m" : "target_height_m", r, &Observer::target_height,
                   std::optional(r.target_height), items);
  add_of_observers("radius_m", r, &Observer::radius, r.radius, items);
  add_of_observers("min_radius_m", r, &Observer::min_radius,
                   r.min_radius > 0 ? std::optional(r.min_radius) : std::nullopt, items);
  add_of_observers("azimuth_deg", r, &Observer::azimuth, r.azimuth, items);
  add_of_observers("elevation_deg", r, &Observer::elevation, r.elevation, items);
  if (r.mode == Mode::kProbability) {
    items.emplace_back("vertical_error_m", fmt::format("{:.12g}", r.vertical_error.sigma));
    items.emplace_back("error_correlation_m", fmt::format("{:.12g}", r.vertical_error.correlation_length));
  }
  if (r.mode == Mode::kFresnel) {
    items.emplace_back("wavelength_m", fmt::format("{:.12g}", r.fresnel.wavelength));
    items.emplace_back("fresnel", fmt::format("{:.12g}", r.fresnel.fraction));
  }
  if (studies_paths(r)) {
    items.emplace_back("frequency_ghz", fmt::format("{:.12g}", r.radio.frequency_ghz));
    items.emplace_back("effective_earth_km", fmt::format("{:.12g}", r.radio.effective_earth_km));
    items.emplace_back("polarisation", r.radio.polarisation == Polarisation::kVertical ? "v" : "h");
    items.emplace_back("over_sea", fmt::format("{:.12g}", r.radio.over_sea));
  }
  if (r.mode == Mode::kLevel) {
    add_budget(r.budget, items);
    add_of_antennas("antenna1_azimuths_deg", r, &profile::AimedAntenna::azimuth_deg, items);
    add_of_antennas("antenna1_tilts_deg", r, &profile::AimedAntenna::tilt_deg, items);
  }
  if (r.mode == Mode::kBlocker) {
    for (std::size_t i = 0; i < result.theme_names.size(); ++i)
      items.emplace_back(fmt::format("theme_{}", i + 1), result.theme_names[i]);
  }
  return items;
}

/// Returns one band after the other.
std::vector<float> together(std::vector<float> first, const std::vector<float>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<float> bands_of(const VisibilityIndex& index) {
  return together(together(index.share, index.standard_error), index.undecided);
}

/// Returns numbers from 1 as a band of floats; 0, which stands for none, has no value.
std::vector<float> band_of_numbers(const std::vector<std::uint32_t>& numbers) {
  std::vector<float> band;
  band.reserve(numbers.size());
  for (const std::uint32_t number : numbers)
    band.push_back(number == 0 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(number));
  return band;
}

/// Writes a result's values under one description. Each mode has functions that return the values of a part of the
/// result, one band after the other.
class Writer {
 public:
  Writer(const std::string& path, const Result& result, RasterDescription description, const Progress& progress)
      : path_(path), result_(result), description_(std::move(description)), progress_(progress) {}

  void verdicts(const std::string& band) {
    description_.classes = verdict_classes(result_);
    description_.classes.push_back({code_of(Verdict::kOutside), "outside or no data", kTransparent});
    // The file lists the classes in this order.
    std::ranges::sort(description_.classes, {}, &RasterClass::value);
    write<std::uint8_t>({band}, code_of(Verdict::kOutside), [](const Result& part) { return codes_of(part.visible); });
  }
  void losses() {
    write<float>({"diffraction loss (ITU-R P.526, delta-Bullington), dB", "free-space loss, dB"}, kNaN,
                 [](const Result& part) {
                   const auto& losses = part.get<Losses>();
                   return together(losses.diffraction_db, losses.free_space_db);
                 });
  }
  void levels() {
    const Request& request = result_.request;
    std::vector<std::string> bands{"received level, dBm"};
    const std::optional<double>& sensitivity = request.budget.sensitivity_dbm;
    if (sensitivity) bands.emplace_back("margin over the sensitivity, dB");
    if (tells_outage(request)) bands.emplace_back("outage by rain, minutes a year; 5.26 and less counts as 5.26");
    if (request.observers.size() > 1) bands.emplace_back("observer that serves best, its number from 1");
    write<float>(bands, kNaN, [&](const Result& part) {
      const auto& levels = part.get<Levels>();
      std::vector<float> values = levels.level_dbm;
      if (sensitivity)
        for (const float level : levels.level_dbm) values.push_back(static_cast<float>(level - *sensitivity));
      values = together(std::move(values), levels.outage_minutes);
      if (request.observers.size() > 1) values = together(std::move(values), band_of_numbers(levels.observer));
      return values;
    });
  }
  void counts() {
    write<std::uint16_t>(
        {"observers that see the cell"}, kCountOutside,
        [](const Result& part) -> const auto& { return part.get<Counts>().count; });
  }
  void angles() {
    write<float>(
        {"elevation angle of the sight line, degrees; of several observers the greatest"}, kNaN,
        [](const Result& part) -> const auto& { return part.get<Angles>().angle_deg; });
  }

  void heights() {
    const char* base = result_.request.targets_on_surface ? "the surface with its features" : "the ground";
    const char* unknown = result_.leaves_open() ? ", or ground without data leaves it open" : "";
    write<float>(
        {fmt::format("least height above {} at which a target is seen, metres; no value: at none{}", base, unknown)},
        kNaN, [](const Result& part) -> const auto& { return part.get<LeastHeights>().height_m; });
  }
  void probabilities() {
    const std::string unknown = result_.leaves_open() ? "; no value: ground without data leaves it open" : "";
    const std::string open = result_.leaves_open() ? "; 2: undecided" : "";
    write<float>(
        {"probability of being visible, in 512 simulated surfaces" + unknown, "visible as the heights are" + open},
        kNaN, [](const Result& part) {
          std::vector<float> values = part.get<Probabilities>().probability;
          values.reserve(2 * values.size());
          for (const Verdict v : part.visible)
            values.push_back(v == Verdict::kOutside ? std::numeric_limits<float>::quiet_NaN()
                                                    : static_cast<float>(code_of(v)));
          return values;
        });
  }
  void blockers() {
    const std::string unknown = result_.crosses_voids && result_.request.nodata != NoData::kClear
                                    ? fmt::format(", {}: ground without data comes first", kMissingGround)
                                    : "";
    std::vector<std::string> bands{"theme of what hides the cell, 0: terrain" + unknown};
    if (!result_.get<Blockers>().feature.empty()) bands.emplace_back("its feature, by its number in the theme, from 0");
    write<std::uint32_t>(bands, kNoBlocker, [](const Result& part) {
      std::vector<std::uint32_t> values = part.get<Blockers>().theme;
      const std::vector<std::uint32_t>& feature = part.get<Blockers>().feature;
      values.insert(values.end(), feature.begin(), feature.end());
      return values;
    });
  }

  void bits() {
    const std::vector<Observer>& observers = result_.request.observers;
    std::vector<std::string> bands(bit_grids(observers.size()));
    for (std::size_t i = 0; i < observers.size(); ++i) {
      std::string& band = bands[raster_bit(i).grid];
      if (!band.empty()) band += ", ";
      const std::string& name = observers[i].name;
      band += fmt::format("bit {}: {}", i % 32, name.empty() ? std::to_string(i + 1) : name);
    }
    write<std::uint32_t>(
        bands, std::nullopt, [](const Result& part) -> const auto& { return part.get<ObserverSets>().words; });
  }

  void nearest() {
    write<float>({"distance of the nearest visible observer, metres", "its number, from 1"}, kNaN,
                 [](const Result& part) {
                   const auto& nearest = part.get<NearestObservers>();
                   return together(nearest.distance_m, band_of_numbers(nearest.number));
                 });
  }

 private:
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  template <class T, class ValuesOf>
  void write(const std::vector<std::string>& bands, std::optional<double> nodata, const ValuesOf& values_of) {
    description_.band_name = bands.front();
    description_.further_bands.assign(bands.begin() + 1, bands.end());
    description_.nodata = nodata;
    write_raster_of<T>(path_, result_, values_of, description_, progress_);
  }

  const std::string& path_;
  const Result& result_;
  RasterDescription description_;
  const Progress& progress_;
};

}  // namespace

void write_geotiff(const std::string& path, const Result& result, const GeotiffOptions& options,
                   const Progress& progress) {
  RasterDescription description;
  description.crs_wkt = options.crs_wkt;
  description.overwrite = options.overwrite;
  description.metadata = metadata_of(result);
  description.metadata.insert(description.metadata.end(), options.metadata.begin(), options.metadata.end());
  Writer writer(path, result, std::move(description), progress);
  switch (result.request.mode) {
    case Mode::kVisible:
      return writer.verdicts(result.certified ? "certified" : "visible");
    case Mode::kCount:
      return writer.counts();
    case Mode::kWhich:
      return writer.bits();
    case Mode::kAngle:
      return writer.angles();
    case Mode::kNearest:
      return writer.nearest();
    case Mode::kBlocker:
      return writer.blockers();
    case Mode::kHeight:
      return writer.heights();
    case Mode::kProbability:
      return writer.probabilities();
    case Mode::kFresnel:
      return writer.verdicts("first Fresnel zone");
    case Mode::kLoss:
      return writer.losses();
    case Mode::kLevel:
      return writer.levels();
  }
}

void write_geotiff(const std::string& path, const VisibilityIndex& index, const IndexRequest& request,
                   const GeotiffOptions& options, const Progress& progress) {
  RasterDescription description;
  description.crs_wkt = options.crs_wkt;
  description.nodata = std::numeric_limits<double>::quiet_NaN();
  description.band_name = "share of the ground within the radius that is seen";
  description.further_bands = {"standard error of the share",
                               "share of that ground that ground without data alone could hide"};
  description.metadata = {{"radius_m", fmt::format("{:g}", request.radius)},
                          {"observer_height_m", fmt::format("{:g}", request.height)},
                          {"target_height_m", fmt::format("{:g}", request.target_height)},
                          {index.sample.rays > 0 ? "rays" : "targets",
                           fmt::format("{}", std::max(index.sample.rays, index.sample.targets))},
                          {"nodata_rule", nodata_text(request.nodata)},
                          {"refraction", request.earth.convention()}};
  description.metadata.insert(description.metadata.end(), options.metadata.begin(), options.metadata.end());
  description.overwrite = options.overwrite;
  write_raster_of<float>(path, index, bands_of, description, progress);
}

}  // namespace itin::viewshed
