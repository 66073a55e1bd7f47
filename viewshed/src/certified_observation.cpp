#include "certified_observation.hpp"

#include <viewshed/certified.hpp>

#include "verdicts.hpp"

namespace itin::viewshed {

std::uint8_t CertifiedObservation::verdict(std::size_t cell) const {
  if (value(cell) == kOutside) return kOutside;
  if (value(cell) == kVisible) return kCertainlyVisible;
  return doubted_[cell] ? kUndecided : kCertainlyHidden;
}

void CertifiedObservation::store_row(std::size_t cell, std::size_t columns, std::size_t place, Result& result) const {
  for (std::size_t i = 0; i < columns; ++i) result.visible[place + i] = verdict(cell + i);
}

void CertifiedObservation::count_row(std::size_t cell, std::size_t columns, CellCounts& cells) const {
  for (std::size_t i = cell; i < cell + columns; ++i) count(verdict(i), cells);
}

}  // namespace itin::viewshed
