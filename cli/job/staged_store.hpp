// A store on a disk of this machine, in place of one on a file server.
#pragma once

#include <string>

#include <itin/progress.hpp>

namespace itin::cli {

/// Copies the store into the folder, unless it is there, and returns the copy's path. Several processes may do so at
/// the same time. Throws FileError, Cancelled.
std::string staged_store(const std::string& store, const std::string& folder, const Progress& progress);

}  // namespace itin::cli
