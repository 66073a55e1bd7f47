// How frequent the symbols of an alphabet have been so far, which is what a range decoder needs to know of them. The
// frequencies are counted anew with every symbol, and put to use at intervals that become longer and longer.
//
// The method is that of A. Said, "Introduction to Arithmetic Coding" (HPL-2004-76), with the numbers that the LAZ
// format has for it. Encoder and decoder must count alike to the last bit.
#pragma once

#include <cstdint>
#include <vector>

namespace itin {

class SymbolModel {
 public:
  static constexpr unsigned kScaleBits = 15;  ///< frequencies add up to about 2^15

  /// All symbols are equally frequent. Precondition: 2 to 2048 symbols.
  explicit SymbolModel(std::uint32_t symbols);

  std::uint32_t last() const { return static_cast<std::uint32_t>(counts_.size()) - 1; }
  /// The scaled frequency of all lower symbols together.
  std::uint32_t below(std::uint32_t symbol) const { return below_[symbol]; }
  /// The highest symbol with below(symbol) <= `scaled`.
  std::uint32_t symbol_at(std::uint32_t scaled) const {
    const std::uint32_t bucket = scaled >> bucket_shift_;
    if (bucket + 1 >= first_.size()) return last();
    std::uint32_t low = first_[bucket], high = first_[bucket + 1] + 1;
    while (high - low > 1) {
      const std::uint32_t middle = (low + high) / 2;
      (below_[middle] <= scaled ? low : high) = middle;
    }
    return low;
  }
  void count(std::uint32_t symbol) {
    ++counts_[symbol];
    if (--until_update_ == 0) update();
  }

 private:
  void update();

  std::vector<std::uint32_t> counts_, below_;
  std::vector<std::uint16_t> first_;  ///< the symbol at the beginning of each bucket of scaled frequencies
  std::uint32_t bucket_shift_;
  std::uint32_t total_ = 0, cycle_ = 0, until_update_ = 0;
};

/// Counts how often each of two choices was made, likewise.
class BitModel {
 public:
  static constexpr unsigned kScaleBits = 13;

  /// The scaled frequency of 0.
  std::uint32_t below_one() const { return below_one_; }
  void count(bool one) {
    zeros_ += one ? 0 : 1;
    if (--until_update_ == 0) update();
  }

 private:
  void update();

  std::uint32_t zeros_ = 1, total_ = 2, below_one_ = std::uint32_t{1} << (kScaleBits - 1);
  std::uint32_t cycle_ = 4, until_update_ = 4;
};

}  // namespace itin
