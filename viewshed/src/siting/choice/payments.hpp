// What options pay for the demand that they serve, so that no choice pays more for an element than its weight.
#pragma once

#include <cstddef>
#include <vector>

#include "siting/choice/shared_demand.hpp"

namespace itin::viewshed {

/// Options among which a choice is to be completed.
struct OpenChoice {
  std::vector<std::size_t> chosen;
  std::vector<std::size_t> open;  ///< options that no chosen one excludes, ascending
  std::vector<double> shares;     ///< by option: the multipliers u
};

class Payments {
 public:
  explicit Payments(const SharedDemand& demand);

  /// Takes what the chosen ones serve as served. Returns its weight.
  Weight serve(const std::vector<std::size_t>& chosen);
  /// Returns what an option serves besides.
  Weight gain(std::size_t option);
  /// Returns what each open option pays where `count` of them are still to be chosen.
  std::vector<double> of(const OpenChoice& choice, std::size_t count);

  /// How many classes have been looked at so far.
  double work() const { return work_; }

 private:
  const SharedDemand& demand_;
  std::vector<bool> served_;  ///< by class
  std::vector<double> sums_;  ///< sums of shares, by class
  std::vector<std::uint32_t> payers_;
  double work_ = 0;
};

}  // namespace itin::viewshed
