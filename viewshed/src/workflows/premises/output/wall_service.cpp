#include "workflows/premises/output/wall_service.hpp"

namespace itin::viewshed {

WallService service_of(const WallPlace& wall, double storey) {
  if (wall.mast) return wall.height_m <= storey ? WallService::kLow : WallService::kHigh;
  return wall.undecided ? WallService::kUndecided : WallService::kUnserved;
}

PremisesService service_of(const Premises& premises) {
  switch (premises.verdict()) {
    case Verdict::kVisible:
      return premises.best_mounting().on == MountedOn::kWall ? PremisesService::kWall : PremisesService::kRoof;
    case Verdict::kUndecided:
      return PremisesService::kUndecided;
    case Verdict::kOutside:
      return PremisesService::kOutOfReach;
    case Verdict::kHidden:
    case Verdict::kZoneCut:
      return PremisesService::kUnserved;
  }
  return PremisesService::kUnserved;
}

const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kVisible:
      return "served";
    case Verdict::kZoneCut:
      return "zone cut";
    case Verdict::kHidden:
      return "hidden";
    case Verdict::kUndecided:
      return "undecided";
    case Verdict::kOutside:
      return "out of reach";
  }
  return "";
}

const char* word_of(MountedOn on) {
  return on == MountedOn::kWall ? "wall" : "roof";
}

std::string theme_of(std::uint16_t theme, const StoreMetadata& metadata) {
  return theme == 0 ? "terrain" : metadata.themes[theme - std::size_t{1}].name;
}

}  // namespace itin::viewshed
