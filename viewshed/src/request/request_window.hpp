// The ground that the sight lines of a Request may pass over.
#pragma once

#include <vector>

#include <itin/store.hpp>
#include <itin/window.hpp>
#include <viewshed/request.hpp>

namespace itin::viewshed {

/// A hull that holds the sight lines from an observer to places in the box, which may be empty. Convex,
/// counterclockwise.
std::vector<Point2> hull_about(Point2 observer, const Box& box);

/// The region that holds every sight line of the request: a convex one about each observer, or about observers that
/// stand close together.
Window window_of(const Request& request);
/// The part of the data that the request's sight lines lie over; empty where they lie over none.
Box area_under(const Store& store, const Request& request);
/// A box about all that the request's window may hold of the store.
Box box_of_window(const Store& store, const Request& request);

}  // namespace itin::viewshed
