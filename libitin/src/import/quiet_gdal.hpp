// GDAL prints its errors on stderr unless told otherwise; a library must not.
#pragma once

#include <string>

#include <cpl_error.h>

namespace itin {

/// While one lives, GDAL prints nothing on this thread.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  /// What GDAL said last, on one line; `otherwise` if it said nothing.
  static std::string reason(const char* otherwise) {
    std::string text = CPLGetLastErrorMsg();
    for (char& c : text) {
      if (c == '\n' || c == '\r') c = ' ';
    }
    return text.empty() ? otherwise : text;
  }
};

}  // namespace itin
