// About how long the parts of a call take, so that its progress grows evenly: seconds of one thread, as measured
// (benchmarks/README.md). Nothing else depends on it.
#pragma once

#include <cstdint>

#include <viewshed/request.hpp>

#include "plan/memory.hpp"

namespace itin::viewshed {

/// What it takes to read a surface, and to decide what is asked over it.
struct Effort {
  double reading = 0, judging = 0;

  double all() const { return reading + judging; }
  double share_of_reading() const { return all() > 0 ? reading / all() : 0; }
};

/// Reading a surface of so many points as the posts of a lattice, as triangles, or as the two surfaces of an envelope.
double effort_of_posts(std::uint64_t points);
double effort_of_triangles(std::uint64_t points);
double effort_of_envelope(std::uint64_t points);

/// Deciding this number of sight lines: each by itself, or all about an eye by a sweep.
double effort_of_lines(double lines);
double effort_of_swept_lines(double lines);
/// Looking so often at the ground along rays over the posts of a lattice, from many observers at once.
double effort_of_looks(double looks);
/// Reading a surface of so many points, and deciding the request for every observer on this number of cells.
Effort effort_of_viewshed(const Request& request, std::uint64_t points, std::uint64_t cells, SurfaceForm form);

}  // namespace itin::viewshed
