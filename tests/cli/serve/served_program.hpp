// `itin serve` in a process of its own, on a port that is free.
#pragma once

#include <cstdint>
#include <string>
#include <sys/types.h>
#include <vector>

namespace itin::test {

class ServedProgram {
 public:
  /// Starts the program, and waits until it has said where it listens. `arguments` follow `itin serve --port 0`.
  explicit ServedProgram(const std::vector<std::string>& arguments);
  /// Ends it, if it runs, and expects that it has lived until then.
  ~ServedProgram();
  ServedProgram(const ServedProgram&) = delete;
  ServedProgram& operator=(const ServedProgram&) = delete;

  std::uint16_t port() const { return port_; }
  const std::string& key() const { return key_; }
  const std::string& url() const { return url_; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  pid_t process() const { return process_; }

  struct End {
    int status = 0;
    std::string errors;
  };
  /// Sends a signal and waits for the end.
  End end(int signal);

 private:
  pid_t process_ = 0;
  int errors_ = -1;
  std::string url_, key_;
  std::uint16_t port_ = 0;
};

}  // namespace itin::test
