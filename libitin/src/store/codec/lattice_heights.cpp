#include "store/codec/lattice_heights.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <itin/precondition.hpp>

namespace itin {

namespace {

constexpr std::size_t kGroup = 8;  ///< residuals of one width, which take as many bytes as each of them has bits
constexpr int kCodes = 15;         ///< codes of widths above 0: the least such width and the 14 after it
constexpr int kWidest = 36;        ///< bits of a residual: heights differ by 2^32, so residuals by 2^34

/// The code of a group's width, two in a byte.
int code_of_group(std::span<const std::uint8_t> codes, std::size_t group) {
  return codes[group / 2] >> group % 2 * 4 & 15;
}

using Group = std::array<std::uint64_t, kGroup>;

int width_of(std::span<const std::uint64_t> residuals) {
  return std::bit_width(*std::max_element(residuals.begin(), residuals.end()));
}

std::vector<std::uint64_t> residuals_of(std::span<const std::int64_t> heights, std::size_t columns) {
  std::vector<std::uint64_t> residuals((heights.size() + kGroup - 1) / kGroup * kGroup, 0);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const bool west = i % columns > 0, south = i >= columns;
    residuals[i] = zigzag(heights[i] - (west ? heights[i - 1] : 0) - (south ? heights[i - columns] : 0) +
                          (west && south ? heights[i - columns - 1] : 0));
  }
  return residuals;
}

void put_group(std::vector<std::uint8_t>& out, std::span<const std::uint64_t> residuals, int width) {
  std::uint64_t pending = 0;
  int count = 0;
  for (const std::uint64_t r : residuals) {
    pending |= r << count;
    for (count += width; count >= 8; count -= 8, pending >>= 8) out.push_back(static_cast<std::uint8_t>(pending));
  }
}

Group read_group(const std::uint8_t* bytes, unsigned width) {
  Group residuals;
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  for (unsigned i = 0; i < kGroup; ++i) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i * width / 8, sizeof word);
    if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
    residuals[i] = word >> i * width % 8 & mask;
  }
  return residuals;
}

}  // namespace

void put_lattice_heights(std::vector<std::uint8_t>& out, std::span<const std::int64_t> heights, std::size_t columns) {
  ITIN_PRECONDITION(columns >= 1 && !heights.empty() && heights.size() % columns == 0 && heights[0] == 0);
  const std::vector<std::uint64_t> residuals = residuals_of(heights, columns);
  const auto group = [&](std::size_t g) { return std::span(residuals).subspan(g * kGroup, kGroup); };
  const std::size_t groups = residuals.size() / kGroup;
  const int least = std::max(1, width_of(residuals) - kCodes + 1);
  std::vector<std::uint8_t> codes((groups + 1) / 2, 0);
  for (std::size_t g = 0; g < groups; ++g) {
    const int width = width_of(group(g));
    const int code = width == 0 ? 0 : std::max(width, least) - least + 1;
    codes[g / 2] |= static_cast<std::uint8_t>(code << g % 2 * 4);
  }
  out.push_back(static_cast<std::uint8_t>(least));
  out.insert(out.end(), codes.begin(), codes.end());
  for (std::size_t g = 0; g < groups; ++g) {
    const int code = code_of_group(codes, g);
    if (code > 0) put_group(out, group(g), least + code - 1);
  }
}

void read_lattice_heights(ByteReader& in, std::span<std::int64_t> heights, std::size_t columns) {
  const std::size_t groups = (heights.size() + kGroup - 1) / kGroup;
  const int least = in.byte();
  if (least < 1 || least > kWidest - kCodes + 1) throw DecodeError("widths of heights are out of range");
  const std::span<const std::uint8_t> codes = in.bytes((groups + 1) / 2);
  if (groups % 2 == 1 && codes.back() >> 4 != 0) throw DecodeError("has heights beyond its last one");
  const auto width = [&](std::size_t g) {
    const int code = code_of_group(codes, g);
    return code == 0 ? 0U : static_cast<unsigned>(least + code - 1);
  };
  std::size_t size = 0;
  for (std::size_t g = 0; g < groups; ++g) size += width(g);
  const std::span<const std::uint8_t> packed = in.bytes(size);
  // A group is read in words, which may reach beyond the last byte.
  std::vector<std::uint8_t> padded(size + sizeof(std::uint64_t), 0);
  std::copy(packed.begin(), packed.end(), padded.begin());
  const std::uint8_t* next = padded.data();
  for (std::size_t g = 0; g < groups; ++g) {
    const Group residuals = read_group(next, width(g));
    next += width(g);
    const std::size_t first = g * kGroup, count = std::min(kGroup, heights.size() - first);
    for (std::size_t i = 0; i < count; ++i) heights[first + i] = unzigzag(residuals[i]);
    for (std::size_t i = count; i < kGroup; ++i)
      if (residuals[i] != 0) throw DecodeError("has heights beyond its last one");
  }
  if (heights[0] != 0) throw DecodeError("does not begin with its first height");
  for (std::size_t row = 0; row < heights.size(); row += columns) {
    std::int64_t sum = 0;
    for (std::size_t i = row; i < row + columns; ++i) {
      sum += heights[i];
      heights[i] = sum + (row > 0 ? heights[i - columns] : 0);
    }
  }
}

}  // namespace itin
