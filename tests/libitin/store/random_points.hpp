// Seeded sets of points and whole stores for the tests of the store.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <itin/geometry.hpp>

#include "geometry/cell.hpp"
#include "store/codec/point_index.hpp"
#include "support/temporary_directory.hpp"

namespace itin {
class StoreWriter;
}

namespace itin::test {

/// Sorted along the Morton curve, one point per position.
std::vector<GridPoint> in_curve_order(std::vector<GridPoint> points);

/// One by one.
std::vector<std::uint16_t> each_of(const PointSources& sources);

enum class Scatter { Uniform, Clustered, Lattice, SparseLattice, Line, FlatLattice };
/// Up to `count` points of `cell` in curve order; lattices have steps that are no powers of two.
std::vector<GridPoint> scatter(Scatter how, const Cell& cell, std::size_t count, std::mt19937_64& random);

/// A leaf as it was given to the writer: of the ground where the level is 0.
struct GivenLeaf {
  int level = 0;
  Cell cell;
  std::vector<GridPoint> points;
  std::vector<std::uint16_t> sources;
  std::vector<std::uint8_t> levels;  ///< one for each point; none but in the ground
  std::int32_t lo = 0, hi = 0;
};

/// The data that a store was written from: the slow twin that its reader is compared with.
struct GivenStore {
  std::vector<double> tolerances;
  int fine_levels = 2;
  std::vector<GivenLeaf> leaves;  ///< in the writer's order
  std::vector<Segment> segments;
  Grid grid{{1000, -2000}, 0.01};

  void write(const std::string& path) const;
  /// Adds the first leaves, or all.
  void add_leaves(StoreWriter& writer, std::size_t most = ~std::size_t{0}) const;
};
GivenStore random_store(std::uint64_t seed, std::size_t points, int levels = 4);

std::string read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

}  // namespace itin::test
