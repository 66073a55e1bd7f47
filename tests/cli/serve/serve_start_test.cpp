// How the server starts and ends.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

using ServeStart = ServedHill;

TEST_F(ServeStart, SaysWhereItIs) {
  EXPECT_EQ(server_->url(), fmt::format("http://127.0.0.1:{}/#key={}", server_->port(), server_->key()));
  const std::string first = server_->key();
  serve();
  EXPECT_NE(server_->key(), first);
}

TEST_F(ServeStart, EndsBySignals) {
  for (const int signal : {SIGINT, SIGTERM}) {
    serve();
    WebSocketClient client(*server_);
    WebSocketClient::welcome(client, *server_);
    const auto start = std::chrono::steady_clock::now();
    const ServedProgram::End end = server_->end(signal);
    EXPECT_EQ(end.status, 130);
    EXPECT_EQ(end.errors, "");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    const auto told = client.read();
    ASSERT_TRUE(told);
    EXPECT_EQ(told->opcode, WebSocketClient::kClose);
    EXPECT_EQ(told->code(), 1001);
    server_.reset();
  }
}

TEST_F(ServeStart, SaysThatThePortIsTaken) {
  const Outcome outcome = shell_.run(fmt::format("itin serve hill.itin --port {}", server_->port()));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, fmt::format("itin: error: --port {}: is taken on 127.0.0.1; give another one, or 0 for any "
                                     "that is free\n",
                                     server_->port()));
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
}

TEST_F(ServeStart, OpensABrowserOrSaysInOneLineThatThereIsNone) {
  const std::string path = std::getenv("PATH");
  ASSERT_EQ(setenv("PATH", (shell_.directory() / "bin:").string().append(path).c_str(), 1), 0);
  const auto told = [&](const std::string& opener) {
    shell_.run("mkdir -p bin; printf '#!/bin/sh\\n" + opener +
               "\\n' > bin/xdg-open; chmod +x bin/xdg-open; rm -f opened");
    serve({"--open"});
    const std::string url = server_->url();
    EXPECT_TRUE(eventually([&] { return shell_.read("opened") == url + "\n"; }));
    const std::string errors = server_->end(SIGINT).errors;
    server_.reset();
    return errors;
  };
  const std::string write = "echo \"$1\" > " + (shell_.directory() / "opened").string();
  EXPECT_EQ(told(write), "");
  const std::string none = told("echo no links2 >&2; echo no lynx; " + write + "; exit 3");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(none.find("no l"), std::string::npos) << none;
  EXPECT_NE(none.find("itin: warning: --open: no browser opened; open the printed URL by hand\n"), std::string::npos)
      << none;
}

TEST_F(ServeStart, RefusesWrongCalls) {
  const auto expect = [&](const std::string& options, int status, const std::string& error) {
    const Outcome outcome = shell_.run("itin serve hill.itin " + options);
    EXPECT_EQ(outcome.status, status) << options;
    EXPECT_EQ(outcome.out, "") << options;
    EXPECT_EQ(outcome.err, "itin: error: " + error + "\n");
  };
  expect("--port 0 --host 0.0.0.0", 2,
         "--host '0.0.0.0': other machines may reach it; say by --allow-host NAME what browsers call this one");
  expect("--port 0 --host nowhere.invalid", 2, "--host 'nowhere.invalid': is no address or name of this machine");
  expect("--port 65536", 2, "--port '65536': expected a whole number from 0 to 65535");
  expect("--memory 1M", 2, "--memory: the server needs at least 64M");
  EXPECT_EQ(shell_.run("itin serve absent.itin").status, 1);
  EXPECT_EQ(shell_.run("itin serve hill.asc").status, 1);
}

TEST_F(ServeStart, HasOtherNames) {
  serve({"--host", "0.0.0.0", "--allow-host", "Map.example", "--allow-host", "proxy.example:443"});
  EXPECT_TRUE(server_->url().starts_with(fmt::format("http://map.example:{}/#key=", server_->port())))
      << server_->url();
  const auto status = [&](const std::string& host) { return ask(*server_, "/api/v1/info", {.host = host}).status; };
  EXPECT_EQ(status(fmt::format("map.EXAMPLE:{}", server_->port())), 200);
  EXPECT_EQ(status("proxy.example:443"), 200);
  EXPECT_EQ(status("localhost:" + std::to_string(server_->port())), 200);
  EXPECT_EQ(status("proxy.example"), 403);
  EXPECT_EQ(status("other.example:443"), 403);
}

}  // namespace

}  // namespace itin::test
