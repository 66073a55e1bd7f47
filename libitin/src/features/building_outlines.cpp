#include <algorithm>

#include <itin/building_outlines.hpp>
#include <itin/simplified.hpp>

#include "store/footprint_codec.hpp"

namespace itin {

namespace {

class OutlineCollection {
 public:
  OutlineCollection(const Box& box, const OutlineDetail& detail) : box_(box), detail_(detail) {}

  void add(const FootprintFeature& feature) {
    for (const PlanRing& ring : feature.rings) add(ring);
    if (!feature.rings.empty()) return;
    for (const RoofSurface& surface : feature.surfaces) {
      PlanRing outline;
      for (const Point3& p : surface.rings.front()) outline.push_back({p.x, p.y});
      add(std::move(outline));
    }
  }
  std::vector<std::vector<Point2>> finish() && { return std::move(rings_); }

 private:
  void add(PlanRing ring) {
    Box box;
    for (const Point2& p : ring) box.extend(p);
    if (ring.empty() || std::max(box.width(), box.height()) < detail_.least || !box_.meets(box)) return;
    ring.push_back(ring.front());
    std::vector<Point2> outline = simplified(ring, detail_.tolerance);
    if (outline.size() > 2) rings_.push_back(std::move(outline));
  }

  Box box_;
  OutlineDetail detail_;
  std::vector<std::vector<Point2>> rings_;
};

}  // namespace

std::vector<std::vector<Point2>> building_outlines(const Store& store, const ThemeChoice& themes, const Box& box,
                                                   const OutlineDetail& detail) {
  OutlineCollection outlines(box, detail);
  const std::vector<ThemeInfo>& known = store.metadata().themes;
  for (std::size_t t = 0; t < known.size(); ++t) {
    const bool houses = known[t].kind == ThemeKind::Buildings || known[t].kind == ThemeKind::Terraces;
    if (!houses || !themes.includes(known[t])) continue;
    for (std::uint32_t block = 0; block < known[t].footprint_blocks; ++block)
      for (const StoredFootprint& footprint : stored_footprints(store, static_cast<std::uint16_t>(t + 1), block))
        outlines.add(footprint.feature);
  }
  return std::move(outlines).finish();
}

}  // namespace itin
