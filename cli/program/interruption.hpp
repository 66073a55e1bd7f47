// Ctrl-C and its kin: the first asks the running call to stop and clean up; one that comes more than a second
// later ends the process at once.
#pragma once

namespace itin::cli {

/// Catches SIGINT, SIGTERM and SIGHUP from now on; a closed pipe and a file beyond the shell's limit become
/// write errors instead of signals.
void catch_interruptions();

bool interrupted();

}  // namespace itin::cli
