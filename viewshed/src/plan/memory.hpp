// The memory that a viewshed takes: for its rasters, and for each point of its surface.
#pragma once

#include <cstdint>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

// Peak memory for each point of a surface, as measured. A point of a lattice takes kBytesPerPost.
inline constexpr std::uint64_t kBytesPerSurfacePoint = 400,  ///< triangulation, triangles and bins
    kBytesPerEnvelopePoint = 715,                            ///< two surfaces, and the bounds that they make
    kBytesPerCastEnvelopePoint = 1200;                       ///< two surfaces, and a scene for the rays to each

/// A surface with its features has about this many times the points of the bare one.
inline constexpr std::uint64_t kPointsWithFeatures = 3;

/// Tells whether the request can be answered over the posts of a lattice alone: at full detail, in a mode that asks no
/// more than sight lines, by the sweep.
bool takes_a_lattice(const Store& store, const Request& request);

/// What a scene of rays takes for each point of its surface: 160 to 170 bytes were measured over lidar and rasters.
inline constexpr std::uint64_t kBytesPerPointOfRays = 200;

/// Returns kBytesPerSurfacePoint, and what the engine and the mode add.
std::uint64_t bytes_per_point(const Request& request);

/// About how many points the surface of this detail has within the box.
std::uint64_t points_about(const Store& store, const Detail& detail, const Box& box);

/// A surface is held as triangles, or as the posts of a lattice.
enum class SurfaceForm : std::uint8_t { kTriangles, kPosts };
/// About how many bytes it takes to hold a surface, or to retrieve it.
std::uint64_t bytes_held(const Store& store, const Detail& detail, const Box& area, SurfaceForm form);

/// Tells whether the memory holds ground of so many bytes. A little is never too much: the program takes as much by
/// itself.
bool holds_ground(std::uint64_t memory, std::uint64_t bytes);

/// The memory that keeps the ground of cells, beside surfaces that take this much: a quarter of all, or what is left.
std::uint64_t memory_for_ground(std::uint64_t memory, std::uint64_t surfaces);

/// Throws InputError where rasters of these cells are large and leave less than a quarter of the memory; `bytes` is
/// what they take on the way and in the end.
void require_memory_for_rasters(const RasterGrid& cells, std::uint64_t bytes, std::uint64_t memory);
/// Throws InputError where the request's rasters do so.
void require_memory_for_rasters(const Store& store, const Request& request, std::uint64_t memory);
/// Tells whether the request's rasters leave enough memory.
bool holds_rasters(std::uint64_t memory, const Store& store, const Request& request);

/// The memory that rasters of this size leave, but no less than a quarter of all.
std::uint64_t memory_beside(std::uint64_t raster_bytes, std::uint64_t memory);

/// The memory that the request's rasters leave, but no less than a quarter of all.
std::uint64_t memory_beside_rasters(std::uint64_t memory, const Store& store, const Request& request);

}  // namespace itin::viewshed
