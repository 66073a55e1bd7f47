#include "siting/choice/shared_demand.hpp"

#include <algorithm>

namespace itin::viewshed {

namespace {

/// How many members all sets may have together, at four bytes each.
constexpr std::size_t kMostMembers = std::size_t{1} << 23;
constexpr std::size_t kNoOption = static_cast<std::size_t>(-1);
constexpr std::uint32_t kNoClass = 0;

class Classes {
 public:
  Classes(const ChoiceProblem& problem, const std::vector<bool>& open)
      : problem_(problem), served_(problem, {}), class_of_(64 * problem.demand.block_count(), kNoClass), parts_(1) {
    for (std::size_t option = 0; option < open.size(); ++option)
      if (open[option]) options_.push_back(option);
    leave_out_excess();
  }

  SharedDemand run() && {
    for (const std::size_t option : options_) {
      divide_by(option);
      if (parts_.size() > 2 * class_of_.size()) forget_empty();
    }
    SharedDemand result{weights_of_classes(), {}};
    result.of_option.resize(problem_.options.size());
    number_without_gaps(result.weights);
    for (const std::size_t option : options_) result.of_option[option] = classes_of(option);
    return result;
  }

 private:
  /// What becomes of a class where an option serves a part of it.
  struct Part {
    std::size_t option = kNoOption;
    std::uint32_t served = kNoClass;
  };

  void leave_out_excess() {
    std::vector<std::size_t> of_block(problem_.demand.block_count());
    for (const std::size_t option : options_)
      for (const DemandSet::Block& block : set(option).blocks())
        of_block[block.number] += static_cast<std::size_t>(std::popcount(block.members));
    std::size_t members = 0;
    for (end_ = 0; end_ < of_block.size() && members + of_block[end_] <= kMostMembers; ++end_)
      members += of_block[end_];
  }

  const DemandSet& set(std::size_t option) const { return problem_.coverage.bounds(option).certain; }

  template <class Visit>
  void for_each_new(std::size_t option, const Visit& visit) const {
    for_each_element(set(option), [&](std::size_t element) {
      if (element / 64 < end_ && !served_.least.enough(element)) visit(element);
    });
  }

  void divide_by(std::size_t option) {
    for_each_new(option, [&](std::size_t element) {
      std::uint32_t& number = class_of_[element];
      if (parts_[number].option != option) {
        parts_[number] = {option, static_cast<std::uint32_t>(parts_.size())};
        parts_.push_back({});
      }
      number = parts_[number].served;
    });
  }

  /// Numbers the classes anew, since classes that were divided into others may have nothing left.
  void forget_empty() {
    std::vector<std::uint32_t> numbers(parts_.size(), kNoClass);
    std::uint32_t count = kNoClass;
    for (std::uint32_t& number : class_of_) {
      if (number == kNoClass) continue;
      if (numbers[number] == kNoClass) numbers[number] = ++count;
      number = numbers[number];
    }
    parts_.assign(std::size_t{count} + 1, {});
  }

  std::vector<Weight> weights_of_classes() const {
    std::vector<Weight> weights(parts_.size());
    for (std::size_t element = 0; element < class_of_.size(); ++element)
      if (class_of_[element] != kNoClass)
        weights[class_of_[element]] +=
            problem_.demand.weight(static_cast<std::uint32_t>(element / 64), std::uint64_t{1} << (element % 64));
    return weights;
  }

  /// Leaves out classes without weight.
  void number_without_gaps(std::vector<Weight>& weights) {
    numbers_.assign(weights.size(), kNoClass);
    std::size_t count = 0;
    for (std::size_t c = 1; c < weights.size(); ++c) {
      if (weights[c] == 0) continue;
      weights[count++] = weights[c];
      numbers_[c] = static_cast<std::uint32_t>(count);
    }
    weights.resize(count);
    listed_.assign(count, kNoOption);
  }

  std::vector<std::uint32_t> classes_of(std::size_t option) {
    std::vector<std::uint32_t> result;
    for_each_new(option, [&](std::size_t element) {
      const std::uint32_t number = numbers_[class_of_[element]];
      if (number == kNoClass || listed_[number - 1] == option) return;
      listed_[number - 1] = option;
      result.push_back(number - 1);
    });
    std::sort(result.begin(), result.end());
    return result;
  }

  const ChoiceProblem& problem_;
  ServedBounds served_;  ///< what existing sites serve
  std::vector<std::size_t> options_;
  std::size_t end_ = 0;  ///< the first block that is left out
  std::vector<std::uint32_t> class_of_;
  std::vector<Part> parts_;             ///< by class
  std::vector<std::uint32_t> numbers_;  ///< in the result, from 1; by class
  std::vector<std::size_t> listed_;     ///< the last option that each class was listed for
};

}  // namespace

SharedDemand shared_demand(const ChoiceProblem& problem, const std::vector<bool>& open) {
  return Classes(problem, open).run();
}

}  // namespace itin::viewshed
