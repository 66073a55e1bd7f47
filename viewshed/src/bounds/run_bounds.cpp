#include "bounds/run_bounds.hpp"

namespace itin::viewshed {

const RunBounds::Tile RunBounds::kBare = [] {
  Tile bare;
  for (auto* const of : {&bare.low, &bare.high})
    for (Runs& runs : *of) runs.fill(-std::numeric_limits<float>::infinity());
  return bare;
}();

}  // namespace itin::viewshed
