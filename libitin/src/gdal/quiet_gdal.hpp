// GDAL without its own messages: what it has to say goes into exceptions.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include <cpl_error.h>
#include <cpl_port.h>

namespace itin {

/// While one lives, this thread's GDAL errors are kept, not printed. What is asked of all is answered by this thread's
/// innermost one, of which there must be one.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandlerEx(remember, this); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  /// Whether anything failed since it began, even if GDAL went on afterwards.
  static bool failed() { return innermost().failure_.has_value(); }
  /// The first failure on one line, else what GDAL warned of last, else `otherwise`.
  static std::string message(const std::string& otherwise) {
    const QuietGdal& self = innermost();
    std::string text = self.failure_.value_or(self.warning_);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? otherwise : text;
  }

 private:
  static QuietGdal& innermost() { return *static_cast<QuietGdal*>(CPLGetErrorHandlerUserData()); }
  static void CPL_STDCALL remember(CPLErr error_class, CPLErrorNum, const char* message) {
    QuietGdal& self = innermost();
    if (error_class < CE_Failure) {
      self.warning_ = message;
    } else if (!self.failure_) {
      self.failure_ = message;
    }
  }

  std::optional<std::string> failure_;
  std::string warning_;
};

}  // namespace itin
