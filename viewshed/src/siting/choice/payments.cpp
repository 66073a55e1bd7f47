#include "siting/choice/payments.hpp"

#include <algorithm>

namespace itin::viewshed {

Payments::Payments(const SharedDemand& demand)
    : demand_(demand), served_(demand.weights.size()), sums_(demand.weights.size()), payers_(demand.weights.size()) {}

Weight Payments::serve(const std::vector<std::size_t>& chosen) {
  std::fill(served_.begin(), served_.end(), false);
  Weight sum = 0;
  for (const std::size_t option : chosen) {
    sum += gain(option);
    for (const std::uint32_t c : demand_.of_option[option]) served_[c] = true;
  }
  return sum;
}

Weight Payments::gain(std::size_t option) {
  Weight sum = 0;
  for (const std::uint32_t c : demand_.of_option[option])
    if (!served_[c]) sum += demand_.weights[c];
  work_ += static_cast<double>(demand_.of_option[option].size());
  return sum;
}

std::vector<double> Payments::of(const OpenChoice& choice, std::size_t count) {
  std::fill(sums_.begin(), sums_.end(), 0);
  std::fill(payers_.begin(), payers_.end(), 0);
  // The greatest shares come first: a choice brings together no more payers than the first `count`.
  std::vector<std::size_t> order = choice.open;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return choice.shares[a] > choice.shares[b]; });
  for (const std::size_t option : order) {
    for (const std::uint32_t c : demand_.of_option[option]) {
      if (served_[c] || payers_[c] >= count) continue;
      ++payers_[c];
      sums_[c] += choice.shares[option];
    }
  }
  std::vector<double> payments;
  for (const std::size_t option : choice.open) {
    double sum = 0;
    for (const std::uint32_t c : demand_.of_option[option])
      if (!served_[c]) sum += static_cast<double>(demand_.weights[c]) / sums_[c];
    payments.push_back(sum * choice.shares[option]);
    work_ += 2 * static_cast<double>(demand_.of_option[option].size());
  }
  return payments;
}

}  // namespace itin::viewshed
