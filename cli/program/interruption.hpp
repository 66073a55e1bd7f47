// Handles Ctrl-C and the like. The first signal asks the running call to stop and clean up. A call that has not stopped
// within a second, as within a long call of another library, is ended: outputs that are not complete are removed, and
// the store is left as it was.
#pragma once

namespace itin::cli {

/// The status that the program ends with when it was interrupted.
inline constexpr int kInterruptedStatus = 130;

/// Catches SIGINT, SIGTERM and SIGHUP from now on. A closed pipe and a file beyond the shell's limit become write
/// errors instead of signals. Where the system grants no thread to end a call that does not stop, only another signal
/// ends the call, a second later or more, and may leave temporary files.
void catch_interruptions();

bool interrupted();

/// Declares that an interruption is how this call is meant to end, so that say_interrupted() tells of no error.
void expect_interruption();

/// Says that the program was interrupted.
void say_interrupted();

/// Declares that the program has come to its end, and is not interrupted any more; to be called once, before its last
/// line. Does not return where the program is being ended already.
void end_interruptions();

}  // namespace itin::cli
