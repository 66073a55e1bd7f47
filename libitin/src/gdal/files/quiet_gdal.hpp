// GDAL without its own messages: they go into exceptions instead.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include <cpl_error.h>
#include <cpl_port.h>

#include <itin/precondition.hpp>

#include "gdal/files/network.hpp"

namespace itin {

/// Keeps this thread's GDAL errors, instead of printing them, for as long as the object lives. The static functions
/// answer for this thread's innermost object. Precondition: there is one.
class QuietGdal {
 public:
  QuietGdal() {
    settle_network();
    CPLPushErrorHandlerEx(remember, this);
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  /// Tells whether anything failed since the object was made, even if GDAL went on afterwards.
  static bool failed() { return innermost().failure_.has_value(); }
  /// Returns why something was refused, else the first failure on one line, else GDAL's last warning, else `otherwise`.
  static std::string message(const std::string& otherwise) {
    if (std::string refused = take_refusal(); !refused.empty()) return refused;
    const QuietGdal& self = innermost();
    std::string text = self.failure_.value_or(self.warning_);
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? otherwise : text;
  }

 private:
  static QuietGdal& innermost() {
    ITIN_PRECONDITION(CPLGetErrorHandlerUserData() != nullptr);
    return *static_cast<QuietGdal*>(CPLGetErrorHandlerUserData());
  }
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
