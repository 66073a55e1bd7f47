// GDAL without its own messages: what it has to say goes into exceptions.
#pragma once

#include <algorithm>
#include <mutex>
#include <string>

#include <cpl_error.h>
#include <gdal.h>

namespace itin {

/// While one lives, this thread's GDAL errors are kept, not printed. Drivers are registered once.
class QuietGdal {
 public:
  QuietGdal() {
    static std::once_flag registered;
    std::call_once(registered, GDALAllRegister);
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  static bool failed() { return CPLGetLastErrorType() >= CE_Failure; }
  /// The last error on one line, or `otherwise`.
  static std::string message(const std::string& otherwise) {
    std::string text = CPLGetLastErrorMsg();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? otherwise : text;
  }
};

}  // namespace itin
