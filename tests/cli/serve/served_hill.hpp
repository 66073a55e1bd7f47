// A small hill, served.
#pragma once

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "cli/serve/served_client.hpp"
#include "cli/serve/served_program.hpp"
#include "cli/shell.hpp"

namespace itin::test {

/// Waits until something holds, for as long as a busy machine may take, and returns whether it does.
template <class Holds>
bool eventually(const Holds& holds) {
  for (const auto end = std::chrono::steady_clock::now() + kPatience; std::chrono::steady_clock::now() < end;) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

class ServedHill : public ::testing::Test {
 protected:
  ServedHill() {
    write_hill(shell_.directory() / "hill.asc");
    shell_.run("itin import hill.itin hill.asc --quiet");
    serve();
  }

  std::string store() const { return (shell_.directory() / "hill.itin").string(); }

  /// Serves the store anew, with further arguments.
  void serve(const std::vector<std::string>& arguments = {}) {
    std::vector<std::string> all{store()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    server_.emplace(all);
  }

  /// These ask as the page does, which knows the key.
  Answer start(const Json& job) const {
    return ask(*server_, "/api/v1/jobs",
               {.method = "POST",
                .headers = {{"X-Itin-Key", server_->key()}, {"Content-Type", "application/json"}},
                .body = job.dump()});
  }
  Answer remove(const std::string& url) const {
    return ask(*server_, url, {.method = "DELETE", .headers = {{"X-Itin-Key", server_->key()}}});
  }
  Json state(const std::string& url) const { return ask(*server_, url).json(); }
  /// Returns the job once it has ended.
  Json ended(const std::string& url) const {
    Json job;
    const bool has_ended = eventually([&] {
      job = state(url);
      return job.at("state") != "queued" && job.at("state") != "running";
    });
    return has_ended ? job : throw std::runtime_error("the job does not end");
  }

  Shell shell_;
  std::optional<ServedProgram> server_;
};

}  // namespace itin::test
