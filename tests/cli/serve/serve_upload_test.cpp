// Uploads: files that clients send, and jobs that read them.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kTurbines =
    "name,x,y,hub_height,rotor_diameter\nT1,301000,171000,60,80\nT2,301300,171200,60,80\n";
constexpr const char* kArea =
    R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:27700"}},"features":[{"type":"Feature",)"
    R"("properties":{},"geometry":{"type":"Polygon","coordinates":[[[300500,170500],[301500,170500],[301500,171500],)"
    R"([300500,170500]]]}}]})";

class ServeUploads : public ServedHill {
 protected:
  Answer upload(const std::string& bytes, const std::string& type = "text/csv") const {
    return ask(*server_, "/api/v1/uploads",
               {.method = "POST", .headers = {{"X-Itin-Key", server_->key()}, {"Content-Type", type}}, .body = bytes});
  }
  Json done(const Json& asked) const {
    const Answer started = start(asked);
    if (started.status != 202) throw std::runtime_error(started.body);
    return ended(started.json().at("url"));
  }

  /// Expects a job's files to be those that its command writes, with the upload beside.
  void expect_bytes_of_command(const Json& job, const std::string& name, const std::string& bytes) {
    ASSERT_EQ(job.at("state"), "done") << job;
    std::ofstream(shell_.directory() / name) << bytes;
    const Outcome outcome = shell_.run(job.at("command").get<std::string>());
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ASSERT_GT(job.at("files").size(), 3u);
    for (const Json& file : job.at("files")) {
      EXPECT_NE(file.at("name"), name);
      // A GeoPackage has the time at which it was made.
      const std::string output = file.at("name");
      if (output.ends_with(".gpkg")) continue;
      EXPECT_EQ(ask(*server_, file.at("url")).body, shell_.read(output)) << output;
    }
  }
};

TEST_F(ServeUploads, TellWhatIsInThem) {
  const Answer table = upload(kTurbines);
  ASSERT_EQ(table.status, 201) << table.body;
  const std::string name = table.json().at("name");
  EXPECT_TRUE(std::regex_match(name, std::regex("upload-[0-9a-f]{32}\\.csv"))) << name;
  EXPECT_EQ(ask(*server_, "/api/v1/uploads/" + name).json(), table.json());
  EXPECT_EQ(ask(*server_, "/api/v1/uploads/upload-1.csv").status, 404);
  EXPECT_EQ(table.json().at("places"),
            Json::parse(R"([{"x":301000,"y":171000,"name":"T1","hub_height_m":60,"rotor_diameter_m":80},
                            {"x":301300,"y":171200,"name":"T2","hub_height_m":60,"rotor_diameter_m":80}])"));
  const Answer area = upload(kArea, "application/geo+json");
  ASSERT_EQ(area.status, 201) << area.body;
  EXPECT_TRUE(area.json().at("name").get<std::string>().ends_with(".geojson")) << area.body;
  EXPECT_EQ(area.json().at("places"), Json::array());
  EXPECT_EQ(area.json().at("rings"), Json::parse("[[300500,170500,301500,170500,301500,171500]]"));
}

TEST_F(ServeUploads, TellRowsThatCannotBeUsed) {
  const Json told = upload("x,y\n301000,171000\nfar,1\n1,2\n").json();
  EXPECT_EQ(told.at("rows"), 3);
  EXPECT_EQ(told.at("unusable"), 2);
  EXPECT_EQ(told.at("places"), Json::parse(R"([{"x":301000,"y":171000}])"));
  const std::string warning = told.at("warnings").at(0);
  EXPECT_EQ(warning.find("2 rows cannot be used: feature 2: its x 'far' is not a number; feature 3: lies off the data"),
            0)
      << warning;
  const Answer swapped = upload("x,y\n171000,301000\n");
  EXPECT_EQ(swapped.status, 400);
  EXPECT_NE(swapped.json().at("error").get<std::string>().find("its coordinates are swapped"), std::string::npos)
      << swapped.body;
}

TEST_F(ServeUploads, GiveTheBytesOfTheCommandLine) {
  const std::string turbines = upload(kTurbines).json().at("name");
  expect_bytes_of_command(
      done(
          {{"verb", "ztv"}, {"options", {{"turbines", turbines}, {"radius", 900}, {"cell", 50}, {"output", "zones"}}}}),
      turbines, kTurbines);
  const std::string area = upload(kArea, "application/geo+json").json().at("name");
  expect_bytes_of_command(done({{"verb", "site"},
                                {"options",
                                 {{"search-area", area},
                                  {"spacing", 300},
                                  {"count", 2},
                                  {"radius", 900},
                                  {"cell", 50},
                                  {"output", "sites"}}}}),
                          area, kArea);
}

TEST_F(ServeUploads, TakePolygonsAsText) {
  const Json job = done({{"verb", "site"},
                         {"options",
                          {{"search-area", "POLYGON ((300500 170500, 301500 170500, 301500 171500, 300500 170500))"},
                           {"demand", "cells"},
                           {"spacing", 300},
                           {"count", 1},
                           {"radius", 900},
                           {"output", "sites"}}}});
  EXPECT_EQ(job.at("state"), "done") << job;
}

TEST_F(ServeUploads, ReadNoFilesOfOthers) {
  const std::string turbines = upload(kTurbines).json().at("name");
  const auto expect = [&](const char* verb, const Json& options, const std::string& error) {
    const Answer refused = start({{"verb", verb}, {"options", options}});
    EXPECT_EQ(refused.status, 400) << options;
    EXPECT_NE(refused.json().at("error").get<std::string>().find(error), std::string::npos) << refused.body;
  };
  for (const char* name : {"/etc/passwd", "upload-9.csv", "../hill.itin", "hill.itin", "POLYGON/(/etc/passwd"})
    expect("site", {{"search-area", name}, {"output", "sites"}}, "give the name of an upload");
  expect("site", {{"search-area", "POLYGON ((0 0, 1 0, 1 1))"}, {"params", turbines}, {"output", "sites"}},
         "--params: give the options themselves");
  expect("ztv", {{"turbines", turbines}, {"output", turbines}}, "give a plain file name");
  expect("ztv", {{"turbines", turbines}, {"like", "/dev/zero"}, {"output", "zones"}}, "give the name of an upload");
  expect("ztv", {{"turbines", turbines}, {"output", "zones"}, {"uploads", true}}, "unknown option");
}

TEST_F(ServeUploads, OfOddKindsAreNotKept) {
  const auto expect = [&](const std::string& bytes, const std::string& type, int status, const std::string& error) {
    const Answer refused = upload(bytes, type);
    EXPECT_EQ(refused.status, status) << error;
    EXPECT_NE(refused.json().at("error").get<std::string>().find(error), std::string::npos) << refused.body;
    EXPECT_EQ(refused.json().at("error").get<std::string>().find('\n'), std::string::npos) << refused.body;
  };
  const std::string vrt =
      "<OGRVRTDataSource><OGRVRTLayer name=\"passwd\"><SrcDataSource>/etc/passwd</SrcDataSource></OGRVRTLayer>"
      "</OGRVRTDataSource>";
  expect(vrt, "application/geo+json", 400, "cannot be read");
  expect(vrt, "text/csv", 400, "holds nothing");
  expect("a,b\n1,2\n", "text/csv", 400, "must name x and y");
  expect(std::string("\x89PNG\r\n\x1a\n\0\0\0\1", 12), "text/csv", 400, ".csv: ");
  expect("{\"type\": \"FeatureCollection\", \"features\": [", "application/geo+json", 400, "cannot be read");
  expect("SQLite format 3", "application/geo+json", 400, "cannot be read");
  expect("x,y\n1,2\n", "application/zip", 415, "send text/csv or application/geo+json");
  EXPECT_EQ(start({{"verb", "premises"}, {"options", {{"masts", "upload-1.csv"}, {"output", "x"}}}}).status, 400);
  EXPECT_EQ(ask(*server_, "/api/v1/uploads", {.method = "POST", .headers = {{"Content-Type", "text/csv"}}, .body = "x"})
                .status,
            403);
}

TEST_F(ServeUploads, HaveSixteenMegabytesAtMost) {
  const std::string row = "301000,171000,a place in the middle of the hill\n";
  std::string table = "x,y,what\n";
  // A sanitizer makes reading so slow that the test would have to wait for minutes.
  const std::size_t megabytes = tested_program().find("sanitized") != std::string::npos ? 1 : 16;
  while (table.size() + row.size() <= megabytes << 20) table += row;
  const Answer taken = upload(table);
  ASSERT_EQ(taken.status, 201) << taken.body;
  EXPECT_EQ(taken.json().at("places").size(), 10000u);
  EXPECT_GT(taken.json().at("rows"), 20000 * megabytes);
  const std::string head = "POST /api/v1/uploads HTTP/1.1\r\nHost: " + server_->host() +
                           "\r\nX-Itin-Key: " + server_->key() + "\r\nContent-Type: text/csv\r\n";
  for (const std::string& rest : {std::string("Content-Length: 16777217\r\n\r\n"),
                                  "Transfer-Encoding: chunked\r\n\r\n1000001\r\n" + std::string(65536, 'x')}) {
    ClientSocket socket(server_->port());
    socket.send(head + rest);
    EXPECT_EQ(read_answer(socket).status, 413) << rest.substr(0, 40);
  }
}

TEST_F(ServeUploads, GoWhenTheyAreRemovedAndWhenTheServerEnds) {
  const fs::path temporary = shell_.directory() / "temporary";
  fs::create_directory(temporary);
  ASSERT_EQ(setenv("TMPDIR", temporary.c_str(), 1), 0);
  serve();
  unsetenv("TMPDIR");
  std::vector<std::string> names;
  for (int i = 0; i < 17; ++i) names.push_back(upload(kTurbines).json().at("name"));
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(temporary)) files += entry.is_regular_file();
  EXPECT_EQ(files, 16u);
  const auto job = [&](const std::string& name) {
    return start({{"verb", "ztv"}, {"options", {{"turbines", name}, {"output", "zones"}}}}).status;
  };
  EXPECT_EQ(job(names[0]), 400);  // the oldest went
  EXPECT_EQ(ask(*server_, "/api/v1/uploads/" + names[0]).status, 404);
  EXPECT_EQ(remove("/api/v1/uploads/" + names[1]).status, 200);
  EXPECT_EQ(remove("/api/v1/uploads/" + names[1]).status, 404);
  EXPECT_EQ(job(names[1]), 400);
  EXPECT_EQ(server_->end(SIGTERM).status, 130);
  EXPECT_TRUE(fs::is_empty(temporary));
  server_.reset();
}

TEST_F(ServeUploads, AreReadTwoAtATime) {
  const std::string begun = "POST /api/v1/uploads HTTP/1.1\r\nHost: " + server_->host() +
                            "\r\nX-Itin-Key: " + server_->key() +
                            "\r\nContent-Type: text/csv\r\nContent-Length: 20\r\n\r\nx,y\n";
  ClientSocket first(server_->port()), second(server_->port());
  first.send(begun), second.send(begun);
  EXPECT_TRUE(eventually([&] { return upload(kTurbines).status == 429; }));
  first.finish();
  int status = 0;
  EXPECT_TRUE(eventually([&] { return (status = upload(kTurbines).status) != 429; }));
  EXPECT_EQ(status, 201);
}

}  // namespace

}  // namespace itin::test
