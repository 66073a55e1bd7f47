// The sets of instructions that this machine has, for code that is compiled for several.
#pragma once

#include <cstdint>
#include <span>

namespace itin::viewshed {

/// All give the same answers.
enum class Instructions : std::uint8_t { kBaseline, kAvx2, kAvx512 };
/// Returns those that this machine has, the widest last.
std::span<const Instructions> instructions_here();

}  // namespace itin::viewshed
