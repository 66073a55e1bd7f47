// A sum of shares that does not depend on their order.
#pragma once

#include <cmath>

#include <itin/int128.hpp>

namespace itin::viewshed {

class ShareSum {
 public:
  /// Takes a number from 0 to 1, to 64 bits behind the point.
  void add(double share) { units_ += static_cast<Int128>(std::ldexp(share, kBits)); }
  ShareSum& operator+=(const ShareSum& other) {
    units_ += other.units_;
    return *this;
  }
  double value() const { return std::ldexp(static_cast<double>(units_), -kBits); }

 private:
  static constexpr int kBits = 64;
  Int128 units_ = 0;
};

}  // namespace itin::viewshed
