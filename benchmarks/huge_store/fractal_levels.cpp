#include "huge_store/fractal_levels.hpp"

#include "huge_store/fractal.hpp"

namespace itin::huge {

namespace {

/// The coarsest stage whose surface lies within the tolerance.
int coarsest_stage(double tolerance) {
  constexpr double decimetres_per_metre = 10;
  int stage = 0;
  while (stage < Fractal::kTopStage && Fractal::greatest_deviation(stage + 1) <= tolerance * decimetres_per_metre)
    ++stage;
  return stage;
}

}  // namespace

std::vector<FractalLevel> levels_of(const std::vector<double>& tolerances) {
  std::vector<FractalLevel> levels;
  for (const double tolerance : tolerances) {
    const int stage = coarsest_stage(tolerance);
    if (!levels.empty() && stage == levels.back().stage) continue;
    if (!levels.empty()) levels.back().steps = stage - levels.back().stage;
    levels.push_back({tolerance, stage, 0});
  }
  return levels;
}

}  // namespace itin::huge
