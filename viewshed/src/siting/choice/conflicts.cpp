#include "siting/choice/conflicts.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace itin::viewshed {

namespace {

constexpr std::size_t kNoGroup = static_cast<std::size_t>(-1);
/// How many pairs of options are looked at, over the whole search.
constexpr double kPackingWork = 1e8;

/// Closes the option and the options that it excludes.
void leave_out_with(const Conflicts& conflicts, std::size_t option, std::vector<bool>& open) {
  open[option] = false;
  for (const std::size_t other : conflicts.with(option)) open[other] = false;
}

/// Puts each open option into the first group whose members it all excludes. Returns the number of groups.
std::size_t group_open(const Conflicts& conflicts, const std::vector<bool>& open, std::vector<std::size_t>& groups) {
  std::vector<std::vector<std::size_t>> members;
  groups.assign(conflicts.size(), kNoGroup);
  for (std::size_t option = 0; option < conflicts.size(); ++option) {
    if (!open[option]) continue;
    std::vector<std::size_t> excluded(members.size());
    for (const std::size_t other : conflicts.with(option))
      if (groups[other] != kNoGroup) ++excluded[groups[other]];
    std::size_t g = 0;
    while (g < members.size() && excluded[g] < members[g].size()) ++g;
    if (g == members.size()) members.emplace_back();
    members[g].push_back(option);
    groups[option] = g;
  }
  return members.size();
}

/// Branches at the option that excludes the most of what is open.
class PackingSearch {
 public:
  PackingSearch(const Conflicts& conflicts, std::size_t count)
      : conflicts_(conflicts),
        count_(count),
        nodes_left_(kPackingWork / (static_cast<double>(conflicts.size() * conflicts.size()) + 1)) {
    std::vector<std::size_t> none;
    extend(none, std::vector<bool>(conflicts.size(), true));
  }

  const std::vector<std::size_t>& best() const { return best_; }
  bool finished() const { return nodes_left_ > 0; }

 private:
  void extend(std::vector<std::size_t>& chosen, const std::vector<bool>& open) {
    if (best_.size() >= count_ || !(nodes_left_ > 0)) return;
    nodes_left_ -= 1;
    std::vector<std::size_t> more = conflicts_.pack(open, count_ - chosen.size());
    if (chosen.size() + more.size() > best_.size()) {
      more.insert(more.begin(), chosen.begin(), chosen.end());
      best_ = std::move(more);
    }
    std::vector<std::size_t> groups;
    if (chosen.size() + group_open(conflicts_, open, groups) <= best_.size()) return;
    const std::size_t branch = most_excluding(open);
    std::vector<bool> rest = open;
    leave_out_with(conflicts_, branch, rest);
    chosen.push_back(branch);
    extend(chosen, rest);
    chosen.pop_back();
    rest = open;
    rest[branch] = false;
    extend(chosen, rest);
  }

  std::size_t most_excluding(const std::vector<bool>& open) const {
    std::size_t best = 0, most = 0;
    for (std::size_t option = 0; option < open.size(); ++option) {
      if (!open[option]) continue;
      const auto& with = conflicts_.with(option);
      const auto excluded =
          static_cast<std::size_t>(std::count_if(with.begin(), with.end(), [&](std::size_t o) { return open[o]; }));
      if (excluded >= most) most = excluded, best = option;
    }
    return best;
  }

  const Conflicts& conflicts_;
  std::size_t count_;
  double nodes_left_;
  std::vector<std::size_t> best_;
};

}  // namespace

Conflicts::Conflicts(const ChoiceRules& rules, std::size_t count) : with_(rules.options.size()) {
  const std::size_t options = size();
  pairs_.resize(options * options);
  for (std::size_t a = 0; a < options; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!rules.place_taken(a, {&b, 1}) && rules.may_join(a, {&b, 1})) continue;
      pairs_[a * options + b] = pairs_[b * options + a] = true;
      with_[a].push_back(b), with_[b].push_back(a);
    }
  }
  for (auto& with : with_) std::sort(with.begin(), with.end());
  const std::size_t number = group_open(*this, std::vector<bool>(options, true), groups_);
  const PackingSearch search(*this, count);
  fitting_ = search.best();
  most_ = search.finished() && fitting_.size() < count ? fitting_.size() : number;
}

std::vector<std::size_t> Conflicts::pack(std::vector<bool> open, std::size_t count) const {
  std::vector<std::size_t> excluded(size());
  for (std::size_t option = 0; option < size(); ++option)
    for (const std::size_t other : with_[option]) excluded[option] += open[other];
  std::vector<std::size_t> result;
  while (result.size() < count) {
    std::size_t best = size();
    for (std::size_t option = 0; option < size(); ++option)
      if (open[option] && (best == size() || excluded[option] < excluded[best])) best = option;
    if (best == size()) break;
    result.push_back(best);
    open[best] = false;
    for (const std::size_t gone : with_[best]) {
      if (!open[gone]) continue;
      open[gone] = false;
      for (const std::size_t other : with_[gone]) --excluded[other];
    }
  }
  return result;
}

Room::Room(const Conflicts& conflicts, std::size_t count)
    : conflicts_(conflicts),
      missing_(count),
      open_(conflicts.size(), true),
      fitting_(conflicts.fitting()),
      left_(conflicts.size(), Left::kUnknown) {}

std::vector<std::size_t> Room::completion(std::size_t option) const {
  std::vector<std::size_t> fitting;
  std::copy_if(fitting_.begin(), fitting_.end(), std::back_inserter(fitting),
               [&](std::size_t other) { return other != option && !conflicts_.between(option, other); });
  if (fitting.size() + 1 >= missing_) return fitting;
  std::vector<bool> rest = open_;
  leave_out_with(conflicts_, option, rest);
  return conflicts_.pack(std::move(rest), missing_ - 1);
}

bool Room::left_by(std::size_t option) {
  Left& left = left_[option];
  if (left == Left::kUnknown) left = completion(option).size() + 1 >= missing_ ? Left::kYes : Left::kNo;
  return left == Left::kYes;
}

void Room::take(std::size_t option) {
  fitting_ = completion(option);
  leave_out_with(conflicts_, option, open_);
  --missing_;
  std::fill(left_.begin(), left_.end(), Left::kUnknown);
}

}  // namespace itin::viewshed
