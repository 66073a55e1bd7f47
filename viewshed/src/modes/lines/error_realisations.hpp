// Normal errors in many realisations, so that one can count in how many of them something holds.
//
//   const ErrorRealisations realisations;
//   const std::span<const float, ErrorRealisations::kCount> errors = realisations.of(vertex);  // one per realisation
//
// The realisations are a Latin hypercube: in kCount realisations each error takes each of kCount equally probable
// values once, in an order of its own. So shares vary less than with independent draws (McKay, Beckman and Conover
// 1979). The orders are the rows of a table, each begun anywhere: two errors have the same order by a chance of 1 in
// 131,072.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace itin::viewshed {

/// Safe for concurrent use. Takes 1 MB.
class ErrorRealisations {
 public:
  static constexpr std::size_t kCount = 512;

  /// Makes the same realisations in every process.
  ErrorRealisations();

  /// Returns errors of mean 0 and standard deviation 1, which are independent of those of other numbers.
  std::span<const float, kCount> of(std::uint64_t number) const;

 private:
  static constexpr std::size_t kRows = 256;

  std::vector<float> rows_;  ///< each row twice, so that it may begin anywhere
};

}  // namespace itin::viewshed
