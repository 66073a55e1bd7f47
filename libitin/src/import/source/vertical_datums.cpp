#include "import/source/vertical_datums.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "gdal/vertical_axis.hpp"

namespace itin {

namespace {

/// Whether all sources of this kind have elevations; features that stand need not.
bool is_ground(const std::string& kind) {
  constexpr ThemeKind kKinds[] = {ThemeKind::Contours, ThemeKind::Breaklines, ThemeKind::Water, ThemeKind::Surface};
  return kind == "terrain" ||
         std::any_of(std::begin(kKinds), std::end(kKinds), [&](ThemeKind k) { return kind == name_of(k); });
}

}  // namespace

VerticalDatums::VerticalDatums(const StoreMetadata& store) {
  for (const SourceInfo& source : store.sources) {
    if (source.source_crs.empty()) continue;
    const Crs crs = parse_crs(source.source_crs, source.path);
    if (is_ground(source.kind) || (crs.heights && !crs.heights->datum.empty())) add(crs, source.path);
  }
  told_ = !warning().empty();
}

void VerticalDatums::add(const Crs& crs, const std::string& place) {
  const std::string datum = crs.heights ? crs.heights->datum : "";
  if (datum.empty()) {
    if (unstated_.empty()) unstated_ = place;
    return;
  }
  if (datum_.empty()) datum_ = datum, place_ = place;
  if (datum != datum_)
    throw InputError(
        fmt::format("{}: heights refer to {}, but those of {} to {}; convert one of them, or take them as they are "
                    "with `allow_mixed_vertical`",
                    place, datum, place_, datum_),
        "allow_mixed_vertical");
}

std::string VerticalDatums::warning() const {
  if (told_ || datum_ != kEllipsoid || unstated_.empty()) return {};
  return fmt::format(
      "{}: heights refer to the ellipsoid, which lies up to 100 m off sea level; {} does not say what its heights "
      "refer "
      "to",
      place_, unstated_);
}

}  // namespace itin
