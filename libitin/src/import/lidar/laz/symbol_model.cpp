#include "import/lidar/laz/symbol_model.hpp"

#include <algorithm>

#include <itin/precondition.hpp>

namespace itin {

namespace {

/// The width of buckets of scaled frequencies, as a power of two: about four symbols share a bucket.
std::uint32_t bucket_shift(std::uint32_t symbols) {
  std::uint32_t bits = 3;
  while (symbols > (std::uint32_t{1} << (bits + 2))) ++bits;
  return SymbolModel::kScaleBits - bits;
}

/// A frequency in a share of 2^31, as a share of 2^bits.
std::uint32_t scaled_to(std::uint32_t share, unsigned bits) {
  return share >> (31 - bits);
}

constexpr std::uint32_t kWholeShare = std::uint32_t{1} << 31;

}  // namespace

SymbolModel::SymbolModel(std::uint32_t symbols)
    : counts_(symbols, 1),
      below_(symbols),
      first_((std::size_t{1} << (kScaleBits - bucket_shift(symbols))) + 1),
      bucket_shift_(bucket_shift(symbols)),
      cycle_(symbols) {
  ITIN_PRECONDITION(symbols >= 2 && symbols <= 2048);
  update();
  cycle_ = until_update_ = (symbols + 6) / 2;
}

void SymbolModel::update() {
  const auto symbols = static_cast<std::uint32_t>(counts_.size());
  if ((total_ += cycle_) > (std::uint32_t{1} << kScaleBits)) {
    total_ = 0;
    for (std::uint32_t& count : counts_) total_ += count = (count + 1) / 2;
  }
  const std::uint32_t scale = kWholeShare / total_;
  std::uint32_t sum = 0, bucket = 0;
  for (std::uint32_t symbol = 0; symbol < symbols; ++symbol) {
    below_[symbol] = scaled_to(scale * sum, kScaleBits);
    sum += counts_[symbol];
    const std::uint32_t at = below_[symbol] >> bucket_shift_;
    while (bucket < at) first_[++bucket] = static_cast<std::uint16_t>(symbol - 1);
  }
  while (bucket + 1 < first_.size()) first_[++bucket] = static_cast<std::uint16_t>(symbols - 1);
  cycle_ = std::min(cycle_ * 5 / 4, (symbols + 6) * 8);
  until_update_ = cycle_;
}

void BitModel::update() {
  if ((total_ += cycle_) > (std::uint32_t{1} << kScaleBits)) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_) ++total_;
  }
  below_one_ = scaled_to(zeros_ * (kWholeShare / total_), kScaleBits);
  cycle_ = std::min<std::uint32_t>(cycle_ * 5 / 4, 64);
  until_update_ = cycle_;
}

}  // namespace itin
