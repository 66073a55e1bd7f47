#include <algorithm>

#include <itin/building_outlines.hpp>
#include <itin/simplified.hpp>

#include "store/segments/footprint_codec.hpp"

namespace itin {

namespace {

/// Calls visit(theme, number, feature) for each building and terrace of the chosen themes that stands: neither the
/// import nor the choice leaves it out.
template <class Visit>
void for_each_building(const Store& store, const ThemeChoice& themes, const Visit& visit) {
  const std::vector<ThemeInfo>& known = store.metadata().themes;
  for (std::size_t t = 0; t < known.size(); ++t) {
    if (!is_of_buildings(known[t]) || !themes.includes(known[t])) continue;
    const auto theme = static_cast<std::uint16_t>(t + 1);
    for_each_footprint(store, theme, [&](std::int64_t number, const StoredFootprint& footprint) {
      if (!themes.omits(theme, number) && !known[t].leaves_out(number)) visit(theme, number, footprint.feature);
    });
  }
}

/// Calls visit(ring) for the outline of each roof plane, and for its holes where `holes`; for a building that has a
/// footprint, for the rings of that instead.
template <class Visit>
void for_each_ring(const FootprintFeature& feature, bool holes, const Visit& visit) {
  for (const PlanRing& ring : feature.rings) visit(ring);
  if (!feature.rings.empty()) return;
  for (const RoofSurface& surface : feature.surfaces) {
    for (std::size_t i = 0; i < (holes ? surface.rings.size() : 1); ++i) {
      PlanRing ring;
      for (const Point3& p : surface.rings[i]) ring.push_back({p.x, p.y});
      visit(std::move(ring));
    }
  }
}

class OutlineCollection {
 public:
  OutlineCollection(const Box& box, const OutlineDetail& detail) : box_(box), detail_(detail) {}

  void add(const FootprintFeature& feature) {
    for_each_ring(feature, false, [&](PlanRing ring) { add(std::move(ring)); });
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
  for_each_building(store, themes,
                    [&](std::uint16_t, std::int64_t, const FootprintFeature& feature) { outlines.add(feature); });
  return std::move(outlines).finish();
}

std::vector<BuildingFoot> building_feet(const Store& store, const ThemeChoice& themes, const Box& box) {
  std::vector<BuildingFoot> feet;
  for_each_building(store, themes, [&](std::uint16_t theme, std::int64_t number, const FootprintFeature& feature) {
    BuildingFoot foot{theme, number, {}};
    Box extent;
    for_each_ring(feature, true, [&](PlanRing ring) {
      if (ring.empty()) return;
      if (ring.front() != ring.back()) ring.push_back(ring.front());
      for (const Point2& p : ring) extent.extend(p);
      foot.rings.push_back(std::move(ring));
    });
    if (!foot.rings.empty() && box.meets(extent)) feet.push_back(std::move(foot));
  });
  return feet;
}

}  // namespace itin
