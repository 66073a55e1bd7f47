// A view that follows its observer: what `itin viewshed` finds, cell by cell as it is decided.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>

#include "serve/ground/served_store.hpp"
#include "serve/http/http_server.hpp"
#include "serve/live/latest_work.hpp"
#include "serve/live/live_tile.hpp"
#include "viewshed/view_options.hpp"

namespace itin::cli {

/// The modes that a live view may have.
std::vector<std::string> live_modes();

/// Understands the options of a view. Throws InputError, also for modes, rings and files that live views do not take.
void take_view(const Document& options, ViewOptions& view);

/// Computes a view, sends its tiles, and tells when it is done. Throws what PagedSurface::compute() throws.
void show_view(ServedStore& served, const LiveNumber& number, const Document& options, LiveConnection& to,
               LatestWork::Run& run);

}  // namespace itin::cli
