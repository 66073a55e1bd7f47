#include "libitin/store/random_points.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>

#include "store/store_writer.hpp"

namespace itin::test {

std::vector<GridPoint> in_curve_order(std::vector<GridPoint> points) {
  std::map<std::uint64_t, GridPoint> by_code;
  for (const GridPoint& p : points) by_code.emplace(morton(p.x, p.y), p);
  points.clear();
  for (const auto& [code, p] : by_code) points.push_back(p);
  return points;
}

std::vector<std::uint16_t> each_of(const PointSources& sources) {
  std::vector<std::uint16_t> each;
  for (std::size_t k = 0; k < sources.size(); ++k) each.push_back(sources[k]);
  return each;
}

std::vector<GridPoint> scatter(Scatter how, const Cell& cell, std::size_t count, std::mt19937_64& random) {
  const GridBox box = cell.box();
  const auto uniform = [&](std::int64_t low, std::int64_t high) {
    return static_cast<std::int32_t>(std::uniform_int_distribution<std::int64_t>(low, high)(random));
  };
  const std::int64_t side = std::int64_t{1} << cell.log2_side;
  const bool sparse = how == Scatter::SparseLattice;
  const std::int64_t step = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(static_cast<double>(side) /
                                   std::sqrt(static_cast<double>(count) * (sparse ? 200 : 1.6))));
  const std::int32_t phase_x = uniform(0, step - 1), phase_y = uniform(0, step - 1);
  const std::int32_t centre_x = uniform(box.xmin, box.xmax), centre_y = uniform(box.ymin, box.ymax);
  std::vector<GridPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    GridPoint p{uniform(box.xmin, box.xmax), uniform(box.ymin, box.ymax), uniform(-5000, 5000)};
    switch (how) {
      case Scatter::Uniform:
        break;
      case Scatter::Clustered:
        p.x = std::clamp(centre_x + uniform(-20, 20), box.xmin, box.xmax);
        p.y = std::clamp(centre_y + uniform(-20, 20), box.ymin, box.ymax);
        break;
      case Scatter::Lattice:
      case Scatter::SparseLattice:
      case Scatter::FlatLattice:
        p.x = static_cast<std::int32_t>(box.xmin + phase_x + step * uniform(0, (side - 1 - phase_x) / step));
        p.y = static_cast<std::int32_t>(box.ymin + phase_y + step * uniform(0, (side - 1 - phase_y) / step));
        p.z = how == Scatter::FlatLattice ? 1234 : p.z / 10 * 10;
        break;
      case Scatter::Line:
        p.y = centre_y;
        break;
    }
    points.push_back(p);
  }
  return in_curve_order(std::move(points));
}

namespace {

/// A vertex of the full surface with its coarsest level.
struct GivenVertex {
  GridPoint point;
  std::uint16_t source = 0;
  std::uint8_t level = 0;
};

std::vector<GivenVertex> random_vertices(const Cell& ground, std::size_t count, int levels, std::mt19937_64& random) {
  std::map<std::uint64_t, GivenVertex> by_code;
  std::uint16_t source = 0;
  for (int level = levels - 1; level >= 0; --level) {
    for (const Scatter how : {Scatter::Uniform, Scatter::Clustered, Scatter::Lattice}) {
      for (const GridPoint& p : scatter(how, ground, count / 3 >> level, random)) {
        if (random() % 10 == 0) source = static_cast<std::uint16_t>(random() % 3);
        by_code.emplace(morton(p.x, p.y), GivenVertex{p, source, static_cast<std::uint8_t>(level)});
      }
    }
  }
  std::vector<GivenVertex> vertices;
  for (const auto& [code, vertex] : by_code) vertices.push_back(vertex);
  return vertices;
}

/// Cuts vertices in curve order into leaves of at most this many, some of them without any.
void cut(const Cell& cell, int level, std::span<const GivenVertex> in, std::size_t most, std::mt19937_64& random,
         std::vector<GivenLeaf>& leaves) {
  if (in.size() > most && cell.log2_side > 4) {
    for (int i = 0; i < 4; ++i) {
      const auto end = std::find_if(in.begin(), in.end(), [&](const GivenVertex& v) {
        return morton(v.point.x, v.point.y) >= cell.child(i).end();
      });
      const auto part = in.first(static_cast<std::size_t>(end - in.begin()));
      cut(cell.child(i), level, part, most, random, leaves);
      in = in.subspan(part.size());
    }
    return;
  }
  if (in.empty() && random() % 3 == 0) return;  // no ground here
  GivenLeaf& leaf = leaves.emplace_back();
  leaf.level = level, leaf.cell = cell;
  for (const GivenVertex& v : in) {
    leaf.points.push_back(v.point);
    leaf.sources.push_back(v.source);
    if (level == 0) leaf.levels.push_back(v.level);
  }
  if (level == 0) return;
  leaf.lo = -static_cast<std::int32_t>(random() % (100U << level));
  leaf.hi = static_cast<std::int32_t>(random() % (100U << level));
  // Where a level has no points the surfaces need not meet.
  if (leaf.points.empty() && random() % 2 == 0) leaf.hi = leaf.lo;
}

}  // namespace

GivenStore random_store(std::uint64_t seed, std::size_t count, int levels) {
  std::mt19937_64 random(seed);
  GivenStore store;
  store.fine_levels = std::min(2, levels);
  for (int level = 0; level < levels; ++level) store.tolerances.push_back(level == 0 ? 0 : 0.5 * (1 << level));
  // An odd place, so that the tree's great divides cross the data.
  const Cell ground{morton(-131072, 0), 17};
  const std::vector<GivenVertex> vertices = random_vertices(ground, count, levels, random);
  cut(ground, 0, vertices, kGroundCapacity / 8, random, store.leaves);
  for (int level = 1; level < levels; ++level) {
    std::vector<GivenVertex> own;
    std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(own),
                 [&](const GivenVertex& v) { return v.level == level; });
    cut(ground, level, own, kLeafCapacity / 4, random, store.leaves);
  }
  const auto uniform = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (std::size_t i = 0; i < count / 10; ++i) {
    const auto x = static_cast<std::int32_t>(uniform(-131072, -1)), y = static_cast<std::int32_t>(uniform(0, 131071));
    const std::int64_t reach = i % 50 == 0 ? 100000 : 2000;
    store.segments.push_back({x, y, static_cast<std::int32_t>(x + uniform(-reach, reach)),
                              static_cast<std::int32_t>(y + uniform(-reach, reach))});
  }
  return store;
}

void GivenStore::add_leaves(StoreWriter& writer, std::size_t most) const {
  writer.set_fine_levels(fine_levels);
  for (std::size_t i = 0; i < std::min(most, leaves.size()); ++i) {
    const GivenLeaf& leaf = leaves[i];
    if (leaf.level == 0) {
      writer.add_ground(leaf.cell, leaf.points, leaf.sources, leaf.levels);
    } else {
      writer.add_leaf(leaf.level, leaf.cell, leaf.points, leaf.sources, leaf.lo, leaf.hi);
    }
  }
}

void GivenStore::write(const std::string& path) const {
  StoreWriter writer(path, "LOCAL_CS[\"test\"]", grid, tolerances);
  add_leaves(writer);
  writer.add_segments(segments);
  std::vector<SourceInfo> sources(3);
  sources[1].path = "b.tif";
  sources[1].gap_basis = {75, 0, 0, 75.5};
  sources[1].spacing = 50;
  writer.commit(sources);
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace itin::test
