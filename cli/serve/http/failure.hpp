// What cannot be done, as clients of the server are told.
#pragma once

#include <string>

#include <itin/document.hpp>

namespace itin::cli {

/// `error`, one line in the words of the command line; and `field`, the option that it begins with, if any.
Document failure_document(const std::string& message);

/// An error that is being handled, with the status of HTTP that goes with it. To be called in a handler of exceptions.
/// Throws nothing but what is being handled, where that is Cancelled.
struct Failure {
  int status = 500;
  std::string message;
};
Failure current_failure();

}  // namespace itin::cli
