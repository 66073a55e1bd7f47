// Whether one set of demand is part of another.
#pragma once

#include <viewshed/demand.hpp>

namespace itin::test {

inline bool is_subset(const viewshed::DemandSet& part, const viewshed::DemandSet& whole) {
  return intersection(part, whole) == part;
}

}  // namespace itin::test
