// Division of whole numbers, rounded down or up, also where they are negative.
#pragma once

namespace itin {

template <class Integer>
constexpr Integer floor_divide(Integer numerator, Integer positive) {
  return numerator / positive - (numerator % positive < 0);
}

template <class Integer>
constexpr Integer ceil_divide(Integer numerator, Integer positive) {
  return numerator / positive + (numerator % positive > 0);
}

}  // namespace itin
