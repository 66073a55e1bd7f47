// Footprints for tests, and what every mesh must obey.
#pragma once

#include <cmath>
#include <iostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "features/mesh/feature_mesh.hpp"
#include "features/plan/hot_pixel.hpp"
#include "support/terrain_tin.hpp"

namespace itin::test {

inline const Grid kFeatureGrid{{300000, 200000}, 0.01};

inline PlanRing box_ring(double xmin, double ymin, double xmax, double ymax) {
  const double x = kFeatureGrid.origin.x, y = kFeatureGrid.origin.y;
  return {{x + xmin, y + ymin}, {x + xmax, y + ymin}, {x + xmax, y + ymax}, {x + xmin, y + ymax}};
}

inline FootprintFeature house(const std::string& name, std::vector<PlanRing> rings, double base, double height,
                              RoofKind roof = RoofKind::flat) {
  FootprintFeature feature;
  feature.name = name;
  feature.rings = std::move(rings);
  feature.base = base;
  feature.height = height;
  feature.roof = roof;
  return feature;
}

inline FeatureMesh meshed(const std::vector<FootprintFeature>& features, const TerrainHeights* terrain = nullptr,
                          FeatureOptions options = {}) {
  NoProgress progress;
  options.grid = terrain ? terrain->grid() : kFeatureGrid;
  return build_feature_mesh(features, options, terrain, progress);
}

inline Position at(const GridPoint& p) {
  return {p.x, p.y};
}

/// All pairs of segments, all vertices: planar, distinct, of different ends.
inline void expect_planar(const FeatureMesh& mesh) {
  const auto& v = mesh.vertices;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const FeatureSegment& s : mesh.segments) {
    ASSERT_NE(s.from, s.to);
    ASSERT_TRUE(edges.insert(std::minmax(s.from, s.to)).second) << "an edge twice";
  }
  std::set<Position> positions;
  for (const GridPoint& p : v) ASSERT_TRUE(positions.insert(at(p)).second) << "a position twice";
  for (auto s = edges.begin(); s != edges.end(); ++s) {
    const Position a = at(v[s->first]), b = at(v[s->second]);
    for (auto t = std::next(s); t != edges.end(); ++t) {
      const Position c = at(v[t->first]), d = at(v[t->second]);
      const int abc = orientation(a, b, c), abd = orientation(a, b, d), cda = orientation(c, d, a),
                cdb = orientation(c, d, b);
      ASSERT_FALSE(abc * abd < 0 && cda * cdb < 0)
          << a.x << ' ' << a.y << ", " << b.x << ' ' << b.y << " x " << c.x << ' ' << c.y << ", " << d.x << ' ' << d.y;
    }
    for (std::uint32_t p = 0; p < v.size(); ++p)
      ASSERT_TRUE(p == s->first || p == s->second || !on_segment(a, b, at(v[p]))) << "a vertex on an edge";
  }
}

inline Side side_of_masks(const FeatureMesh& mesh, Position p) {
  Side found = Side::outside;
  for (const FeatureMask& mask : mesh.masks) {
    const Side side = side_of(mask.polygon, p);
    if (side == Side::inside) return side;
    if (side == Side::border) found = side;
  }
  return found;
}

/// Feet lie on the masks' borders, all else in their closure. Lines that were joined may lie a step off.
inline void expect_masked(const FeatureMesh& mesh) {
  std::set<std::uint32_t> feet;
  for (const FeatureSegment& s : mesh.segments)
    if (s.kind == SegmentClass::foot) feet.insert({s.from, s.to});
  for (const FeatureSegment& s : mesh.segments) {
    for (const std::uint32_t v : {s.from, s.to}) {
      const Side side = side_of_masks(mesh, at(mesh.vertices[v]));
      ASSERT_NE(side, Side::outside);
      ASSERT_TRUE(s.kind == SegmentClass::foot || s.kind == SegmentClass::wall || !feet.contains(v))
          << "a top meets a foot";
    }
  }
  for (const std::uint32_t v : feet) ASSERT_EQ(side_of_masks(mesh, at(mesh.vertices[v])), Side::border);
}

inline double metres(const FeatureMesh& mesh, std::int32_t z) {
  return z * mesh.grid.resolution;
}

/// The least and greatest height of a feature's lines of a class, metres.
inline std::pair<double, double> heights(const FeatureMesh& mesh, std::uint32_t feature, SegmentClass kind) {
  double low = INFINITY, high = -INFINITY;
  for (const FeatureSegment& s : mesh.segments) {
    if (s.feature != feature || s.kind != kind) continue;
    for (const std::uint32_t v : {s.from, s.to}) {
      low = std::min(low, metres(mesh, mesh.vertices[v].z));
      high = std::max(high, metres(mesh, mesh.vertices[v].z));
    }
  }
  return {low, high};
}

inline double mask_area(const FeatureMesh& mesh, std::uint32_t feature) {
  double sum = 0;
  for (const FeatureMask& mask : mesh.masks)
    if (mask.feature == feature) sum += area(mask.polygon);
  return sum * mesh.grid.resolution * mesh.grid.resolution;
}

inline bool reported(const FeatureMesh& mesh, const std::string& text) {
  return std::any_of(mesh.findings.begin(), mesh.findings.end(),
                     [&](const FeatureFinding& f) { return f.text.find(text) != std::string::npos; });
}

inline bool reported(const FeatureMesh& mesh, std::uint32_t feature, const std::string& text) {
  return std::any_of(mesh.findings.begin(), mesh.findings.end(),
                     [&](const FeatureFinding& f) { return f.feature == feature && f.text.starts_with(text); });
}

}  // namespace itin::test
