#include "import/lidar/laz/integer_decoder.hpp"

#include <algorithm>
#include <limits>

namespace itin {

std::int32_t IntegerDecoder::difference(RangeDecoder& decoder, unsigned context) {
  width_ = decoder.symbol(widths_[context]);
  if (width_ == 0) return decoder.bit(narrowest_) ? 1 : 0;
  if (width_ == 32) return std::numeric_limits<std::int32_t>::min();
  std::optional<SymbolModel>& model = high_[width_];
  if (!model) model.emplace(std::uint32_t{1} << std::min(width_, kModelledBits));
  std::uint32_t place = decoder.symbol(*model);
  if (width_ > kModelledBits) place = place << (width_ - kModelledBits) | decoder.bits(width_ - kModelledBits);
  // Differences of this width are -(2^w - 1) to -2^(w-1) in the lower half, and 2^(w-1) + 1 to 2^w in the upper one.
  const std::uint32_t half = std::uint32_t{1} << (width_ - 1);
  return static_cast<std::int32_t>(place >= half ? place + 1 : place - (2 * half - 1));
}

}  // namespace itin
