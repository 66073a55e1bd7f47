// How deep buildings on flat foundations cut into the ground, cell by cell.
//
//   const std::vector<Certificate> cuts = feature_cuts(store, themes, box);
//   use(deepest_cut(cuts, triangle_box));   // there the surface with features is no lower than T_0 less this
#pragma once

#include <cstdint>
#include <vector>

#include <itin/certificate.hpp>
#include <itin/geometry.hpp>
#include <itin/store.hpp>

namespace itin {

/// Returns a certificate for each part of the chosen themes that cuts into the ground in some cell that meets the box.
/// It is empty where features only raise the surface. Throws CorruptStore.
std::vector<Certificate> feature_cuts(const Store& store, const ThemeChoice& themes, const Box& box);

/// Returns the deepest cut, grid units, not negative, in the cells that meet the box.
std::int32_t deepest_cut(const std::vector<Certificate>& cuts, const GridBox& box);

}  // namespace itin
