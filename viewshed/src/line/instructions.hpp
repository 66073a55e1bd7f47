// The sets of instructions that this machine has, for code that is compiled for several.
#pragma once

#include <cstdint>
#include <span>

namespace itin::viewshed {

/// All give the same answers.
enum class Instructions : std::uint8_t { kBaseline, kAvx2, kAvx512 };
/// Returns those that this machine has, the widest last.
std::span<const Instructions> instructions_here();

/// What a function needs to be compiled for them.
#define ITIN_AVX2 [[gnu::target("avx2")]]
#define ITIN_AVX512 [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]]

}  // namespace itin::viewshed
