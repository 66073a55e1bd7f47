// The triangles that hide cells, each once, whatever surface or part of one it was found in.
//
//   BlockerTable table;
//   const std::vector<std::uint32_t> numbers = table.numbers_of(triangles);   // from any number of threads
//   table.give(result);                                                       // in an order of their own
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include <viewshed/result.hpp>

namespace itin::viewshed {

class BlockerTable {
 public:
  /// Returns one number for each triangle; triangles are numbered in the order in which they first come.
  std::vector<std::uint32_t> numbers_of(std::span<const BlockingTriangle> triangles);
  /// Puts the triangles into the result, ascending. Numbers the blockers of its cells, and names their themes,
  /// accordingly.
  void give(Result& result) const;

 private:
  std::mutex mutex_;
  std::map<BlockingTriangle, std::uint32_t> numbers_;
};

}  // namespace itin::viewshed
