// Whether many links are faster over a shared surface or each by itself.
#pragma once

#include <vector>

#include <itin/detail.hpp>
#include <profile/links.hpp>

namespace itin::profile {

/// Triangulating the ground about all links once costs its points; retrieving each link's triangles by themselves costs
/// the triangles. The answer changes the speed only. O(the links' total length).
bool sharing_pays(const Store& store, const Detail& detail, const std::vector<Link>& links);

}  // namespace itin::profile
