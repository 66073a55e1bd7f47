#include "libitin/store/random_points.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
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

GivenStore random_store(std::uint64_t seed, std::size_t count, int levels) {
  std::mt19937_64 random(seed);
  GivenStore store;
  for (int level = 0; level < levels; ++level) store.tolerances.push_back(level == 0 ? 0 : 0.5 * (1 << level));
  // An odd place, so that the tree's great divides cross the data.
  const Cell ground{morton(-131072, 0), 17};
  const auto uniform = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  for (int level = 0; level < levels; ++level) {
    std::vector<GridPoint> points;
    for (const Scatter how : {Scatter::Uniform, Scatter::Clustered, Scatter::Lattice}) {
      const auto part = scatter(how, ground, count / 3 >> level, random);
      points.insert(points.end(), part.begin(), part.end());
    }
    points = in_curve_order(std::move(points));
    const std::function<void(const Cell&, std::span<const GridPoint>)> split = [&](const Cell& cell,
                                                                                   std::span<const GridPoint> in) {
      if (in.size() > kLeafCapacity / 4 && cell.log2_side > 4) {
        for (int i = 0; i < 4; ++i) {
          const auto end = std::find_if(in.begin(), in.end(),
                                        [&](const GridPoint& p) { return morton(p.x, p.y) >= cell.child(i).end(); });
          const auto part = in.first(static_cast<std::size_t>(end - in.begin()));
          split(cell.child(i), part);
          in = in.subspan(part.size());
        }
        return;
      }
      if (in.empty() && uniform(0, 2) == 0) return;  // no ground here
      GivenLeaf leaf{level, cell, {in.begin(), in.end()}, {}, 0, 0};
      for (std::size_t i = 0; i < in.size(); ++i) {
        leaf.sources.push_back(i > 0 && uniform(0, 9) > 0 ? leaf.sources.back()
                                                          : static_cast<std::uint16_t>(uniform(0, 2)));
      }
      if (level > 0) {
        leaf.lo = static_cast<std::int32_t>(-uniform(0, 100 << level));
        leaf.hi = static_cast<std::int32_t>(uniform(0, 100 << level));
        // Where a level has no points the surfaces need not meet.
        if (leaf.points.empty() && uniform(0, 1) == 0) leaf.hi = leaf.lo;
      }
      store.leaves.push_back(std::move(leaf));
    };
    split(ground, points);
  }
  for (std::size_t i = 0; i < count / 10; ++i) {
    const auto x = static_cast<std::int32_t>(uniform(-131072, -1)), y = static_cast<std::int32_t>(uniform(0, 131071));
    const std::int64_t reach = i % 50 == 0 ? 100000 : 2000;
    store.segments.push_back({x, y, static_cast<std::int32_t>(x + uniform(-reach, reach)),
                              static_cast<std::int32_t>(y + uniform(-reach, reach))});
  }
  return store;
}

void GivenStore::write(const std::string& path) const {
  StoreWriter writer(path, "LOCAL_CS[\"test\"]", grid, tolerances);
  for (const GivenLeaf& leaf : leaves) {
    writer.add_leaf(leaf.level, leaf.cell, leaf.points, leaf.sources, leaf.lo, leaf.hi);
  }
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
