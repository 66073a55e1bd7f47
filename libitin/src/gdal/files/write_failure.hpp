// Why GDAL could not write a file, in the system's words.
#pragma once

#include <string>

namespace itin {

/// Returns "cannot be written: No space left on device", or another reason that this thread's innermost QuietGdal has
/// kept, without the names of other libraries' functions and statements; `otherwise` where GDAL gave no reason.
/// Precondition: there is a QuietGdal.
std::string write_failure(const std::string& otherwise);

}  // namespace itin
