// Normal errors in many realisations, to count in how many of them something holds.
//
//   const ErrorRealisations realisations;
//   const std::span<const float, ErrorRealisations::kCount> errors = realisations.of(vertex);  // one per realisation
//
// A Latin hypercube: in its kCount realisations everything takes each of as many equally probable values once, in an
// order of its own, so that shares vary less than those of independent draws (McKay, Beckman and Conover 1979). The
// orders are a table's rows, each begun anywhere: two things have the same one by a chance of 1 in 131,072.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace itin::viewshed {

/// Safe for concurrent use. 1 MB.
class ErrorRealisations {
 public:
  static constexpr std::size_t kCount = 512;

  /// Every process makes equal realisations.
  ErrorRealisations();

  /// They have mean 0 and standard deviation 1, and are independent of those of other numbers.
  std::span<const float, kCount> of(std::uint64_t number) const;

 private:
  static constexpr std::size_t kRows = 256;

  std::vector<float> rows_;  ///< each twice, so that it may begin anywhere
};

}  // namespace itin::viewshed
