// What is known of a line of sight.
//
//   if (verdict == viewshed::Verdict::kUndecided) ...
#pragma once

#include <cstdint>

namespace itin::viewshed {

/// The numbers are those of rasters.
enum class Verdict : std::uint8_t {
  kHidden = 0,
  kVisible = 1,
  kUndecided = 2,  ///< at the detail asked for, or for want of ground
  kOutside = 255   ///< outside every field of view, or no ground to look at
};

}  // namespace itin::viewshed
