// Certificates that know features: how far features take the full surface above, and below, the bounds of the bare
// ground.
//
//   std::vector<HeightBounds> bounds = ...;            // one for each vertex of a level, over the bare ground
//   enclose_features(store, themes, tin, bounds);      // for the surface with these features
//
// Features only raise the surface, except beside their outlines. Their vertices are rounded to the grid, so that the
// ground there is as low, or as high, as the bare ground is a few steps away. Flat foundations cut deeper: the bounds
// that are given must count that already (EnvelopeRequest::cut_by).
#pragma once

#include <vector>

#include <itin/certificate.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>
#include <itin/tin.hpp>

namespace itin::viewshed {

/// Adds to every vertex's bounds the greatest height of features in the index cells that its triangles meet. `bounds`
/// holds the bounds of the bare ground as foundations cut it, one for each vertex. Cost: one look-up of the store's
/// directory per triangle and theme.
void enclose_features(const Store& store, const ThemeChoice& themes, const Tin& tin, std::vector<HeightBounds>& bounds);

}  // namespace itin::viewshed
