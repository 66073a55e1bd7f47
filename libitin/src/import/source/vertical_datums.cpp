#include "import/source/vertical_datums.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin {

VerticalDatums::VerticalDatums(const StoreMetadata& store) {
  for (const SourceInfo& source : store.sources)
    if (!source.source_crs.empty()) add(parse_crs(source.source_crs, source.path), source.path);
}

void VerticalDatums::add(const Crs& crs, const std::string& place) {
  const std::string datum = crs.heights ? crs.heights->datum : "";
  if (datum.empty()) return;
  if (datum_.empty()) datum_ = datum, place_ = place;
  if (datum != datum_)
    throw InputError(
        fmt::format("{}: heights refer to {}, but those of {} to {}; convert one of them, or take them as they are "
                    "with `allow_mixed_vertical`",
                    place, datum, place_, datum_));
}

}  // namespace itin
