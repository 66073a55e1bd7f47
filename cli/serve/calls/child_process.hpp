// This program, run once more: in a group of its own, at a lower priority, with nothing open but its output.
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

#include <itin/progress.hpp>

namespace itin::cli {

class ChildProcess {
 public:
  /// Starts the program in `folder`, with its standard output in the file `output`. Throws Error where the system
  /// refuses.
  ChildProcess(const std::vector<std::string>& arguments, const std::string& folder, const std::string& output);
  /// Ends it, and waits for that.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Reads the next line of its standard error. Returns false once there is no more.
  bool read_line(std::string& line);
  /// Waits for its end and returns its exit status, or 128 and the signal that ended it.
  int wait();
  /// Asks it to end, as Ctrl-C would. Safe to call while another thread reads or waits.
  void terminate();

 private:
  std::mutex mutex_;
  pid_t process_ = 0;  ///< 0: it has ended, and its number may be another one's
  int errors_ = -1;
  std::string read_;
};

/// How a call of the program ended.
struct CallEnd {
  int status = 0;
  std::string error;  ///< in the program's words; empty where it told none
};
/// Hears a process to its end. Throws Cancelled as soon as a line of it comes after the progress was cancelled: it
/// tells of its own several times a second.
CallEnd end_of(ChildProcess& process, const Progress& progress);

/// The error that a line of the program's standard error tells, in its words; nothing for other lines.
std::optional<std::string> told_error(const std::string& line);

}  // namespace itin::cli
