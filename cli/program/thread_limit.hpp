// Finds out whether the system lets this process have the threads that it is going to use.
#pragma once

namespace itin::cli {

/// Throws Error where the system does not grant the threads, for GDAL and oneTBB would wait for them for ever. Starts
/// as many as parallel_for, GDAL and OpenImageIO may have at once, and ends them; none where parallel_for has only one.
void require_threads();

}  // namespace itin::cli
