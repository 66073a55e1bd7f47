#include "bounds/run_bounds.hpp"

#include "line/infinity.hpp"

namespace itin::viewshed {

const RunBounds::Tile RunBounds::kBare = [] {
  Tile bare;
  for (auto* const of : {&bare.low, &bare.high})
    for (Runs& runs : *of) runs.fill(-kFloatInfinity);
  return bare;
}();

}  // namespace itin::viewshed
