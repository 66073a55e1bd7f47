// What was written is on disk, and stays there whatever happens to the machine.
#pragma once

#include <string>

namespace itin {

/// Waits until a folder is on disk, with the names in it. Returns 0, or the error's number, as errno has it.
int sync_folder(const std::string& path);

/// Waits until the folder that has this path is on disk, with the file's name. A folder that may be written but not
/// read is passed over: its entry is on disk with the next flush.
void sync_folder_of(const std::string& path);

}  // namespace itin
