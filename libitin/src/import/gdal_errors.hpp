// GDAL's own error handling, translated once.
#pragma once

#include <algorithm>
#include <string>

#include <cpl_error.h>

namespace itin {

/// Keeps GDAL's messages of this thread to itself while it lives; they are passed on in exceptions.
class QuietErrors {
 public:
  QuietErrors() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietErrors() { CPLPopErrorHandler(); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
};

/// GDAL's last message, on one line.
inline std::string gdal_message() {
  std::string message = CPLGetLastErrorMsg();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

}  // namespace itin
