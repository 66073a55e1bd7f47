// What happens to a server in trouble: a store that changes under it, a full disk, many maps at once. It tells of it in
// one line, and lives on.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sys/resource.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

namespace fs = std::filesystem;

class ServeTrouble : public ServedHill {
 protected:
  static Json view(int id, int seq, const Json& options) {
    return {{"type", "view"}, {"id", id}, {"seq", seq}, {"options", options}};
  }
  static Json message(WebSocketClient& client) {
    while (const auto frame = client.read()) {
      if (frame->opcode != WebSocketClient::kText) continue;
      Json message = Json::parse(frame->payload);
      if (message.at("type") == "done" || message.at("type") == "error") return message;
    }
    throw std::runtime_error("hung up");
  }
  Answer post(const std::string& path, const std::string& type, const std::string& body) const {
    return ask(*server_, path,
               {.method = "POST", .headers = {{"X-Itin-Key", server_->key()}, {"Content-Type", type}}, .body = body});
  }
};

TEST_F(ServeTrouble, AStoreThatChangesIsToldOfInOneLine) {
  const std::string copy = (shell_.directory() / "copy.itin").string();
  const Json options = {{"observer", "301000,171000,5"}, {"radius", "500"}, {"cell", 25}};
  const std::pair<std::string, std::string> changes[] = {
      {"cp copy.itin other.itin && mv other.itin hill.itin", "was changed or replaced since the server started"},
      {"truncate -s 5000 hill.itin", "was changed or replaced since the server started"},
      {"head -c 20000 /dev/urandom | dd of=hill.itin conv=notrunc bs=1000 seek=5 2>/dev/null",
       "was changed or replaced since the server started"},
      {"itin import hill.itin hill.asc --replace --quiet", "was changed or replaced since the server started"},
      {"rm hill.itin", "is no longer there"}};
  shell_.run("cp hill.itin copy.itin");
  for (const auto& [change, error] : changes) {
    shell_.run("cp copy.itin hill.itin");
    serve();
    WebSocketClient client(*server_);
    WebSocketClient::welcome(client, *server_);
    client.send(view(1, 1, options));
    EXPECT_EQ(message(client).at("type"), "done") << change;
    shell_.run(change);
    // clang 14 captures no structured binding by its own name.
    const auto expect_told = [&change = change, &error = error](const Json& told) {
      EXPECT_NE(told.at("error").get<std::string>().find(error), std::string::npos) << change << ": " << told;
      EXPECT_EQ(told.at("error").get<std::string>().find('\n'), std::string::npos) << told;
    };
    client.send(view(1, 2, options));
    expect_told(message(client));
    client.send({{"type", "probe"}, {"id", 1}, {"seq", 3}, {"x", 301200}, {"y", 171000}});
    expect_told(message(client));
    for (const char* path : {"/api/v1/info", "/tiles/heights/0/0/0", "/tin.glb?bbox=300500,170500,301500,171500",
                             "/api/v1/los?from=300200,171000,5&to=301800,171000,5"}) {
      const Answer answer = ask(*server_, path);
      EXPECT_EQ(answer.status, 500) << path;
      expect_told(answer.json());
    }
    expect_told(post("/api/v1/jobs", "application/json", R"({"verb": "los", "options": {}})").json());
    EXPECT_EQ(ask(*server_, "/").status, 200);
  }
}

TEST_F(ServeTrouble, AFullDiskIsToldOfInOneLine) {
  const fs::path temporary = shell_.directory() / "temporary";
  fs::create_directory(temporary);
  ASSERT_EQ(setenv("TMPDIR", temporary.c_str(), 1), 0);
  rlimit all{};
  getrlimit(RLIMIT_FSIZE, &all);
  const rlimit little{4096, all.rlim_max};
  setrlimit(RLIMIT_FSIZE, &little);
  serve();
  setrlimit(RLIMIT_FSIZE, &all);
  unsetenv("TMPDIR");

  std::string table = "x,y\n";
  while (table.size() < 10000) table += "301000,171000\n";
  const Answer upload = post("/api/v1/uploads", "text/csv", table);
  EXPECT_EQ(upload.status, 500) << upload.body;
  EXPECT_TRUE(std::regex_search(upload.json().at("error").get<std::string>(), std::regex("upload-[0-9a-f]{32}\\.csv")))
      << upload.body;
  EXPECT_EQ(post("/api/v1/uploads", "text/csv", "x,y\n301000,171000\n").status, 201);

  const Answer started = post(
      "/api/v1/jobs", "application/json",
      R"({"verb": "viewshed", "options": {"observer": "301000,171000,5", "radius": 900, "cell": 5, "output": "m.tif"}})");
  ASSERT_EQ(started.status, 202) << started.body;
  const Json job = ended(started.json().at("url"));
  EXPECT_EQ(job.at("state"), "failed") << job;
  EXPECT_NE(job.at("error").get<std::string>().find("m.tif"), std::string::npos) << job;
  EXPECT_EQ(job.at("files"), Json::array());
  EXPECT_EQ(ask(*server_, "/tin.glb?bbox=300100,170100,301900,171900").status, 500);
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
  EXPECT_EQ(server_->end(SIGINT).status, 130);
  EXPECT_TRUE(fs::is_empty(temporary));
  server_.reset();
}

/// The most memory that a process has had so far, bytes.
std::uint64_t peak_of(pid_t process) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  throw std::runtime_error("no VmHWM");
}

TEST_F(ServeTrouble, TenMapsStayWithinTheMemory) {
  if (tested_program().find("sanitized") != std::string::npos) GTEST_SKIP() << "sanitizers keep what is freed";
  shell_.run("itin import hills.itin $DEMO/cardiff.tif --quiet");
  for (const std::uint64_t megabytes : {64, 256}) {
    const ServedProgram hills(
        {(shell_.directory() / "hills.itin").string(), "--memory", fmt::format("{}M", megabytes), "--threads", "2"});
    std::vector<std::unique_ptr<WebSocketClient>> clients;
    for (int i = 0; i < 10; ++i) {
      clients.push_back(std::make_unique<WebSocketClient>(hills));
      WebSocketClient::welcome(*clients.back(), hills);
      clients.back()->send(view(1, 1,
                                {{"observer", fmt::format("{},{},20", 308000 + 2500 * i, 178000 + 2500 * i)},
                                 {"radius", "8000"},
                                 {"cell", 50},
                                 {"mode", i % 2 == 0 ? "visible" : "height"}}));
    }
    for (const auto& client : clients) EXPECT_EQ(message(*client).at("type"), "done");
    EXPECT_LE(peak_of(hills.process()) >> 20, megabytes + 64) << megabytes;
  }
}

}  // namespace

}  // namespace itin::test
