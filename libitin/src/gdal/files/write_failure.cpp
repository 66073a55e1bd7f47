#include "gdal/files/write_failure.hpp"

#include <array>
#include <string_view>

#include "gdal/files/quiet_gdal.hpp"

namespace itin {

namespace {

/// What messages of libtiff and SQLite have before the reason: the function or the statement that failed.
constexpr std::array<std::string_view, 4> kCallers{"_tiff", "Attempt to create new tiff", "sqlite3_",
                                                   "failed to execute"};

/// What SQLite says, and what the system says of the same failure or what to do about it.
constexpr std::array<std::array<std::string_view, 2>, 2> kReasons{
    {{"database or disk is full", "No space left on device"},
     {"disk I/O error", "the disk refuses it; check the disk, and the limit on the size of files"}}};

std::string reason_in(const std::string& message) {
  for (const auto& [reason, in_words] : kReasons)
    if (message.ends_with(reason)) return std::string(in_words);
  for (const std::string_view caller : kCallers) {
    if (message.find(caller) == std::string::npos) continue;
    const std::size_t reason = message.find_first_not_of(' ', message.rfind(':') + 1);
    if (reason != std::string::npos) return message.substr(reason);
  }
  return message;
}

}  // namespace

std::string write_failure(const std::string& otherwise) {
  const std::string message = QuietGdal::message("");
  return message.empty() ? otherwise : "cannot be written: " + reason_in(message);
}

}  // namespace itin
