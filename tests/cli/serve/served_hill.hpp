// A small hill, served.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/serve/served_client.hpp"
#include "cli/serve/served_program.hpp"
#include "cli/shell.hpp"

namespace itin::test {

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

  Shell shell_;
  std::optional<ServedProgram> server_;
};

}  // namespace itin::test
