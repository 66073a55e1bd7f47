// How deep buildings on flat foundations cut into the ground, cell by cell.
//
//   for (const Certificate& cut : feature_cuts(store, themes, box))
//     if (auto bounds = cut.over(triangle_box)) ...   // the surface with features is no lower than T_0 + bounds->lo
#pragma once

#include <vector>

#include <itin/certificate.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>

namespace itin {

/// One for each part of the chosen themes that cuts into the ground anywhere in the cells that meet the box; empty
/// where features only raise the surface. Throws CorruptStore.
std::vector<Certificate> feature_cuts(const Store& store, const ThemeChoice& themes, const Box& box);

}  // namespace itin
