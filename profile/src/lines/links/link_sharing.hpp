// Decides whether many links are faster over a shared surface or each by itself.
#pragma once

#include <vector>

#include <itin/cross_section.hpp>
#include <itin/detail.hpp>
#include <profile/links.hpp>

namespace itin::profile {

/// Whether sharing a surface pays. Reading the ground about all links once costs time for its points, few of which are
/// read twice. Retrieving each link's triangles by themselves costs time for the triangles. `surface` is the one to be
/// shared. The answer changes the speed only. O(the links' total length).
bool sharing_pays(const Store& store, const Detail& detail, const std::vector<Link>& links,
                  const SectionSurface& surface);

}  // namespace itin::profile
