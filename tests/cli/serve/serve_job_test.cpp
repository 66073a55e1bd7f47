// Jobs: calls of the program whose files clients take away.
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

namespace fs = std::filesystem;

class ServeJobs : public ServedHill {
 protected:
  /// A call that takes long.
  Json long_job() const {
    return {{"verb", "visibility"},
            {"options", {{"all", true}, {"cell", 2}, {"radius", 2000}, {"targets", 100000}, {"output", "shares.tif"}}}};
  }
};

TEST_F(ServeJobs, WriteTheBytesOfTheCommandLine) {
  const Answer started = start({{"verb", "viewshed"},
                                {"options",
                                 {{"observer", {"301000,171000,5", "300500,171000,2"}},
                                  {"radius", "900"},
                                  {"cell", 10},
                                  {"output", "mast.tif"}}}});
  ASSERT_EQ(started.status, 202) << started.body;
  const Json job = ended(started.json().at("url"));
  ASSERT_EQ(job.at("state"), "done") << job;
  EXPECT_EQ(job.at("share"), 1);
  EXPECT_EQ(job.at("error"), nullptr);
  ASSERT_EQ(job.at("files").size(), 2u) << job;  // the raster and its style
  const Outcome outcome = shell_.run(job.at("command").get<std::string>() + " --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json printed = Json::parse(outcome.out);
  for (const char* name : {"cells", "area_m2", "grid", "outputs"})
    EXPECT_EQ(job.at("document").at(name), printed.at(name)) << name;
  for (const Json& file : job.at("files")) {
    const Answer bytes = ask(*server_, file.at("url"));
    EXPECT_EQ(bytes.body, shell_.read(file.at("name"))) << file;
    EXPECT_EQ(bytes.body.size(), file.at("bytes"));
    EXPECT_TRUE(bytes.headers.at("content-disposition").starts_with("attachment"));
  }
  EXPECT_EQ(ask(*server_, started.json().at("url").get<std::string>() + "/../hill.itin").status, 404);
  EXPECT_EQ(remove(started.json().at("url")).status, 200);
  EXPECT_EQ(ask(*server_, started.json().at("url")).status, 404);
}

TEST_F(ServeJobs, FailAsTheCommandLineDoes) {
  const Answer started = start({{"verb", "viewshed"}, {"options", {{"observer", "1,2,3"}, {"output", "mast.tif"}}}});
  ASSERT_EQ(started.status, 202) << started.body;
  const Json job = ended(started.json().at("url"));
  EXPECT_EQ(job.at("state"), "failed");
  EXPECT_NE(job.at("error").get<std::string>().find("off the data"), std::string::npos) << job;
  EXPECT_EQ(job.at("files"), Json::array());
}

TEST_F(ServeJobs, TouchNoFilesOfOthers) {
  const auto expect = [&](const Json& job, const std::string& error) {
    const Answer refused = start(job);
    EXPECT_EQ(refused.status, 400) << job;
    EXPECT_NE(refused.json().at("error").get<std::string>().find(error), std::string::npos) << refused.body;
  };
  const auto viewshed = [](Json options) {
    options["observer"] = "301000,171000,5";
    return Json{{"verb", "viewshed"}, {"options", options}};
  };
  for (const char* name :
       {"../mast.tif", "/tmp/mast.tif", ".mast.tif", "-mast.tif", "a b.tif", "mast\n.tif", "a/b.tif"})
    expect(viewshed({{"output", name}}), "give a plain file name");
  expect(viewshed({{"like", "/etc/passwd"}, {"output", "mast.tif"}}), "names a file to read");
  expect(viewshed({{"memory", "1T"}, {"output", "mast.tif"}}), "the server's own");
  expect(viewshed({{"output", "mast.tif"}, {"allow-network", true}}), "unknown option");
  expect(viewshed({{"output", "mast.tif"}, {"cell", "none"}}), "--cell");
  expect({{"verb", "import"}}, "'verb' must be one of");
  expect({{"verb", "serve"}}, "'verb' must be one of");
  expect({{"verb", 1}}, "send {");
  expect({{"verb", "viewshed"}, {"options", 1}}, "is not an object");
  expect(Json::array(), "send {");
}

TEST_F(ServeJobs, WaitAndAreCancelled) {
  std::vector<std::string> urls;
  for (int i = 0; i < 3; ++i) {
    const Answer started = start(long_job());
    ASSERT_EQ(started.status, 202) << started.body;
    urls.push_back(started.json().at("url"));
    if (i > 0) continue;
    EXPECT_TRUE(eventually([&] { return state(urls.front()).at("state") != "queued"; }));
  }
  EXPECT_EQ(start(long_job()).status, 429);
  EXPECT_EQ(state(urls[0]).at("state"), "running");
  EXPECT_EQ(state(urls[1]).at("state"), "queued");
  for (const std::string& url : {urls[1], urls[0]}) EXPECT_EQ(remove(url).status, 200);
  EXPECT_TRUE(eventually([&] { return state(urls[2]).at("state") == "running"; }));
  EXPECT_EQ(ask(*server_, urls[0]).status, 404);
}

TEST_F(ServeJobs, LeaveNothingBehind) {
  const fs::path temporary = shell_.directory() / "temporary";
  fs::create_directory(temporary);
  ASSERT_EQ(setenv("TMPDIR", temporary.c_str(), 1), 0);
  serve();
  unsetenv("TMPDIR");
  const std::string url = start(long_job()).json().at("url");
  EXPECT_TRUE(eventually([&] { return state(url).at("state") != "queued"; }));
  EXPECT_FALSE(fs::is_empty(temporary));
  EXPECT_EQ(server_->end(SIGINT).status, 130);
  EXPECT_TRUE(fs::is_empty(temporary));
  server_.reset();
}

}  // namespace

}  // namespace itin::test
