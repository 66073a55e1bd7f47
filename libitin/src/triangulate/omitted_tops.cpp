#include "triangulate/omitted_tops.hpp"

#include <algorithm>

namespace itin {

std::shared_ptr<const GroundBeneath> OmittedTops::kept(const Selection& selection) const {
  const std::lock_guard lock(mutex_);
  const auto known =
      std::find_if(grounds_.begin(), grounds_.end(), [&](const auto& ground) { return ground.first == selection; });
  return known == grounds_.end() ? nullptr : known->second;
}

std::shared_ptr<const GroundBeneath> OmittedTops::ground(const Store& store, const Selection& selection) const {
  const Selection whole = selection.with_all_features();
  if (auto known = kept(whole)) return known;
  // The lock is not held meanwhile: a thread that waits for the triangulation may be given work that comes here.
  auto ground = std::make_shared<const GroundBeneath>(store, whole, themes_);
  const std::lock_guard lock(mutex_);
  grounds_.emplace_back(whole, ground);
  return ground;
}

}  // namespace itin
