// Viewsheds that are certain of what they say about the full surface, without reading all of it.
//
//   viewshed::Request request;
//   request.observers = {{"mast", {318000, 176000}, 20}};
//   request.detail = Detail::tolerance(4);
//   const viewshed::Result certain = viewshed::compute_certified(store, request, {}, progress).result;
//
// Both ends of a sight line stand on the full surface (level 0 of the terrain), whatever the tolerance. "Certainly" is
// what it says: no cell called certain differs from the full surface's exact answer, single precision included.
// Lines of themes that are no terrain lie on the surface and change nothing. Where Request::themes includes themes that
// stand on it, the full surface is the one with them; certificates do not cover these, so that all ground under the
// sight lines is read at full detail.
#pragma once

#include <cstdint>

#include <viewshed/viewshed.hpp>

namespace itin::viewshed {

/// At request.detail, in request.mode kVisible. By the certificates of the store's index cells (law 2): the full
/// surface lies between two envelopes of the level asked for. Finer levels, as small as they are, stand in about every
/// observer, for coarse ground there would hide everything. With several observers a cell is certainly visible when it
/// is to one of them, and certainly hidden when it is to all. Under NoData::kUnknown a line across a void and back is
/// never certainly visible. Cost: as a plain viewshed twice over. Where exact answers cost
/// no more, every cell is decided, but for such lines across voids, as by compute_with_surface() at tolerance 0: with
/// themes that stand on the ground, where the level has half of all points or more, or a hundred-and-twenty-eighth of
/// those of a large raster, or of any surface if that is over a million and a half. Other levels of more than a million
/// and a half points are looked at sector by sector about each observer. Throws as compute() does, and InputError where
/// such themes and voids come together, under another rule than NoData::kClear, in a window that takes more than a
/// gigabyte.
Surveyed compute_certified(const Store& store, const Request& request, const ComputeOptions& options,
                           Progress& progress);

}  // namespace itin::viewshed
