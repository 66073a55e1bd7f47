#include <algorithm>
#include <utility>

#include <viewshed/siting.hpp>

namespace itin::viewshed {

LinkNetwork::LinkNetwork(std::size_t options, std::size_t existing, std::optional<std::size_t> hub, Linked linked)
    : options_(options),
      sites_(options + existing),
      hub_(hub),
      ask_(std::move(linked)),
      links_(sites_ * (sites_ + 1) / 2, Link::kUnknown) {}

LinkNetwork::Link& LinkNetwork::between(std::size_t a, std::size_t b) {
  const auto [low, high] = std::minmax(a, b);
  return links_[high * (high + 1) / 2 + low];
}

std::vector<std::size_t> LinkNetwork::linked(std::size_t site, std::span<const std::size_t> others) {
  std::vector<std::size_t> unknown;
  std::copy_if(others.begin(), others.end(), std::back_inserter(unknown),
               [&](std::size_t other) { return between(site, other) == Link::kUnknown; });
  if (!unknown.empty()) {
    const std::vector<std::size_t> there = ask_(site, unknown);
    for (const std::size_t other : unknown) between(site, other) = Link::kNone;
    for (const std::size_t other : there) between(site, other) = Link::kThere;
  }
  std::vector<std::size_t> result;
  std::copy_if(others.begin(), others.end(), std::back_inserter(result),
               [&](std::size_t other) { return between(site, other) == Link::kThere; });
  return result;
}

}  // namespace itin::viewshed
