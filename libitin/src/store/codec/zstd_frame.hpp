// Zstandard frames with their content size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace itin {

std::vector<std::uint8_t> compress(std::span<const std::uint8_t> bytes);
/// Returns the content. Throws DecodeError where `frame` is none, or holds more than `most` bytes.
std::vector<std::uint8_t> decompress(std::span<const std::uint8_t> frame, std::size_t most);

}  // namespace itin
