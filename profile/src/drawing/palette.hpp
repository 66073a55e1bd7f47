// The colours that all drawings share.
#pragma once

#include "drawing/drawing.hpp"

namespace itin::profile {

inline constexpr Colour kInk{0.12, 0.12, 0.12}, kFaint{0.37, 0.37, 0.37}, kGrid{0.87, 0.87, 0.87}, kPaper{1, 1, 1};

}  // namespace itin::profile
