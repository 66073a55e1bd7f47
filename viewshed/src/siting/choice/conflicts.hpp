// Which options exclude each other, and how many of them can be chosen together.
#pragma once

#include <cstddef>
#include <vector>

#include "siting/choice/choice_state.hpp"

namespace itin::viewshed {

class Conflicts {
 public:
  /// Looks for `count` options that can be chosen together: first takes the options that exclude the fewest others,
  /// then searches by branch and bound for a second or so. O(n^2) calls of `compatible`.
  Conflicts(const ChoiceRules& rules, std::size_t count);

  std::size_t size() const { return with_.size(); }
  bool between(std::size_t a, std::size_t b) const { return pairs_[a * size() + b]; }
  /// The options that this one excludes, ascending.
  const std::vector<std::size_t>& with(std::size_t option) const { return with_[option]; }
  /// The group of each option; any two options of a group exclude each other.
  const std::vector<std::size_t>& groups() const { return groups_; }

  /// Options that can be chosen together: as many as were asked for, or as many as were found.
  const std::vector<std::size_t>& fitting() const { return fitting_; }
  /// No more options than this can be chosen together.
  std::size_t most() const { return most_; }

  /// Takes at most `count` of the `open` options that can be chosen together: always the one that excludes the fewest
  /// of what is left.
  std::vector<std::size_t> pack(std::vector<bool> open, std::size_t count) const;

 private:
  std::vector<bool> pairs_;
  std::vector<std::vector<std::size_t>> with_;
  std::vector<std::size_t> groups_, fitting_;
  std::size_t most_ = 0;
};

/// Whether a choice on its way leaves room for as many options as are still missing.
class Room {
 public:
  Room(const Conflicts& conflicts, std::size_t count);

  /// Tells whether the choice can be filled once this option is taken, which must be compatible with what was taken.
  /// Certain where the answer is yes. Some option always leaves room.
  bool left_by(std::size_t option);
  void take(std::size_t option);

 private:
  enum class Left : unsigned char { kUnknown, kNo, kYes };
  std::vector<std::size_t> completion(std::size_t option) const;

  const Conflicts& conflicts_;
  std::size_t missing_;
  std::vector<bool> open_;            ///< not taken, and not excluded by what was
  std::vector<std::size_t> fitting_;  ///< open options that fill the choice
  std::vector<Left> left_;            ///< one for each option; kUnknown again when one is taken
};

}  // namespace itin::viewshed
