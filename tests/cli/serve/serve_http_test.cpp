// What the server answers by HTTP, and what it refuses.
#include <cmath>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <itin/raster.hpp>
#include <itin/store.hpp>
#include <itin/triangulate.hpp>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

using ServeHttp = ServedHill;

TEST_F(ServeHttp, ShowsThePage) {
  const Answer page = ask(*server_, "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
  EXPECT_EQ(page.headers.at("content-encoding"), "gzip");
  EXPECT_EQ(page.headers.at("cache-control"), "no-cache");
  EXPECT_EQ(page.body.substr(0, 2), "\x1f\x8b");
  EXPECT_EQ(page.body, ask(*server_, "/page/index.html").body);
  EXPECT_EQ(ask(*server_, "/page/../index.html").status, 404);
}

TEST_F(ServeHttp, KeepsPagesToThemselves) {
  for (const char* target : {"/", "/api/v1/info", "/nothing"}) {
    const Answer answer = ask(*server_, target);
    EXPECT_TRUE(answer.headers.at("content-security-policy").starts_with("default-src 'self';")) << target;
    EXPECT_EQ(answer.headers.at("x-content-type-options"), "nosniff") << target;
    EXPECT_EQ(answer.headers.at("cross-origin-resource-policy"), "same-origin") << target;
    EXPECT_FALSE(answer.headers.contains("access-control-allow-origin")) << target;
  }
}

TEST_F(ServeHttp, AnswersToItsNamesAlone) {
  const std::string port = std::to_string(server_->port());
  for (const std::string& host : {"localhost:" + port, "[::1]:" + port})
    EXPECT_EQ(ask(*server_, "/", {.host = host}).status, 200) << host;
  for (const std::string& host :
       std::vector<std::string>{"example.com", "example.com:" + port, "127.0.0.1", "127.0.0.1:1",
                                "localhost:" + port + ".example.com", "localhost.example:" + port}) {
    const Answer answer = ask(*server_, "/api/v1/info", {.host = host});
    EXPECT_EQ(answer.status, 403) << host;
    EXPECT_EQ(answer.json().at("error"), "this name of the server is not allowed; start it with --allow-host NAME");
  }
}

TEST_F(ServeHttp, AnswersToItsOwnPagesAlone) {
  const auto status = [&](const std::string& origin) {
    return ask(*server_, "/api/v1/info", {.headers = {{"Origin", origin}}}).status;
  };
  EXPECT_EQ(status("http://" + server_->host()), 200);
  EXPECT_EQ(status("http://localhost:" + std::to_string(server_->port())), 200);
  for (const std::string& origin :
       std::vector<std::string>{"null", "http://example.com", "http://" + server_->host() + ".example.com",
                                "http://" + server_->host() + "1"})
    EXPECT_EQ(status(origin), 403) << origin;
  EXPECT_THROW(WebSocketClient(*server_, "http://example.com"), std::runtime_error);
  EXPECT_NO_THROW(WebSocketClient(*server_, "http://" + server_->host()));
}

TEST_F(ServeHttp, ChangesNothingWithoutTheKey) {
  const std::string job = R"({"verb": "viewshed", "options": {}})";
  const auto status = [&](const std::string& key, const std::string& type) {
    return ask(*server_, "/api/v1/jobs",
               {.method = "POST", .headers = {{"X-Itin-Key", key}, {"Content-Type", type}}, .body = job})
        .status;
  };
  EXPECT_EQ(status("", "application/json"), 403);
  EXPECT_EQ(status(server_->key().substr(1), "application/json"), 403);
  EXPECT_EQ(status(server_->key() + "0", "application/json"), 403);
  EXPECT_EQ(status(server_->key(), "text/plain"), 415);
  EXPECT_EQ(status(server_->key(), "application/x-www-form-urlencoded"), 415);
  EXPECT_EQ(status(server_->key(), "application/json; charset=utf-8"), 400);  // the job has no observer
  EXPECT_EQ(ask(*server_, "/api/v1/jobs/1", {.method = "DELETE"}).status, 403);
  EXPECT_EQ(ask(*server_, "/", {.method = "PUT"}).status, 405);
}

TEST_F(ServeHttp, LivesOnAfterWhatIsNoRequest) {
  const std::string host = "Host: " + server_->host() + "\r\n";
  const std::string key = "X-Itin-Key: " + server_->key() + "\r\nContent-Type: application/json\r\n";
  const std::pair<std::string, int> requests[] = {
      {"\r\n\r\n\x01\x02\x03 what\r\n\r\n", 400},
      {"GET\r\n\r\n", 400},
      {"GET / HTTP/9.9\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + host + "\r\n", 400},
      {"GET /%zz HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET /%00 HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET http://elsewhere/ HTTP/1.1\r\n" + host + "\r\n", 400},
      {"GET / HTTP/1.1\r\nX: " + std::string(20000, 'x') + "\r\n\r\n", 431},
      {"POST /api/v1/jobs HTTP/1.1\r\n" + host + "Content-Length: 20000\r\n\r\n", 413},
      {"POST /api/v1/jobs HTTP/1.1\r\n" + host + "Content-Length: -1\r\n\r\n", 400},
      {"POST /api/v1/jobs HTTP/1.1\r\n" + host + key + "Transfer-Encoding: chunked\r\n\r\nzz\r\n", 400},
      {"POST /api/v1/jobs HTTP/1.1\r\n" + host + "Content-Length: 10000\r\n\r\n", 403}};
  for (const auto& [request, status] : requests) {
    ClientSocket socket(server_->port());
    socket.send(request);
    EXPECT_EQ(read_answer(socket).status, status) << request.substr(0, 100);
  }
  for (const std::string& gone : {std::string(), std::string("GET"), "GET / HTTP/1.1\r\n" + host}) {
    ClientSocket socket(server_->port());
    socket.send(gone);
  }
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
}

TEST_F(ServeHttp, KeepsConnections) {
  ClientSocket socket(server_->port());
  for (int i = 0; i < 3; ++i) {
    socket.send("GET /api/v1/info HTTP/1.1\r\nHost: " + server_->host() + "\r\n\r\n");
    EXPECT_EQ(read_answer(socket).status, 200);
  }
}

TEST_F(ServeHttp, TakesThirtyTwoConnections) {
  std::vector<std::unique_ptr<WebSocketClient>> clients;
  for (int i = 0; i < 32; ++i) {
    clients.push_back(std::make_unique<WebSocketClient>(*server_));
    WebSocketClient::welcome(*clients.back(), *server_);
  }
  EXPECT_EQ(ask(*server_, "/").status, 429);
  clients.pop_back();
  int status = 429;
  for (int i = 0; i < 100 && status == 429; ++i) status = ask(*server_, "/").status;
  EXPECT_EQ(status, 200);
}

TEST_F(ServeHttp, TellsWhatTheStoreHolds) {
  const Json info = ask(*server_, "/api/v1/info").json();
  const Json printed = Json::parse(shell_.run("itin info hill.itin --json").out);
  for (const char* name : {"crs", "crs_name", "bounds", "levels", "themes", "sources", "vertices"})
    EXPECT_EQ(info.at(name), printed.at(name)) << name;
  EXPECT_EQ(info.at("store"), "hill.itin");
  EXPECT_EQ(info.at("data_spacing_m"), 50);
  EXPECT_EQ(info.at("most_cells"), 2048 * 2048);
  EXPECT_EQ(info.at("modes"), Json({"visible", "count", "angle", "height", "probability"}));
  EXPECT_EQ(info.at("tiles").at("resolutions"), Json({16.0}));
  EXPECT_EQ(info.at("tiles").at("themes"), Json::array());
}

TEST_F(ServeHttp, HasTilesOfHeights) {
  const Json tiles = ask(*server_, "/api/v1/info").json().at("tiles");
  const double pixel = tiles.at("resolutions").back(), west = tiles.at("origin")[0], north = tiles.at("origin")[1];
  const Answer answer = ask(*server_, "/tiles/heights/0/0/0?v=1");
  EXPECT_EQ(answer.headers.at("content-type"), "application/octet-stream");
  EXPECT_EQ(answer.headers.at("cache-control"), "private, max-age=31536000, immutable");
  std::vector<float> heights(answer.body.size() / sizeof(float));
  std::memcpy(heights.data(), answer.body.data(), answer.body.size());
  const Store store(this->store());
  NoProgress progress;
  const std::vector<float> expected =
      heights_at(store, RasterGrid({west - pixel, north + pixel}, pixel, pixel, 258, 258), Detail::tolerance(0),
                 ThemeChoice::none(), progress);
  ASSERT_EQ(heights.size(), expected.size());
  EXPECT_EQ(std::memcmp(heights.data(), expected.data(), answer.body.size()), 0);
  EXPECT_TRUE(std::any_of(heights.begin(), heights.end(), [](float h) { return !std::isnan(h); }));
  EXPECT_EQ(ask(*server_, "/tiles/heights/0/9/9").status, 204);
  for (const char* none : {"/tiles/heights/1/0", "/tiles/heights/a/0/0", "/tiles/heights/0/0/0/0",
                           "/tiles/heights/0/-1/0", "/tiles/theme/none/0/0/0", "/tiles/heights/99999999999/0/0"})
    EXPECT_EQ(ask(*server_, none).status, 404) << none;
}

TEST_F(ServeHttp, JudgesLinesAsTheCommandLine) {
  const Json line =
      ask(*server_, "/api/v1/los?from=300200,171000,5&to=301800,171000,5&frequency=7.5&effective-earth=4%2F3").json();
  Json printed = Json::parse(shell_
                                 .run("itin los hill.itin --from 300200,171000,5 --to 301800,171000,5 "
                                      "--frequency 7.5 --effective-earth 4/3 --json")
                                 .out);
  for (const char* name : {"itin", "command", "outputs", "statistics"}) printed.erase(name);
  for (const auto& [name, value] : printed.items()) EXPECT_EQ(line.at(name), value) << name;
  const Json& profile = line.at("profile");
  const std::size_t places = profile.at("distance_m").size();
  ASSERT_GE(places, 200u);
  double least = 1e9;
  for (std::size_t i = 0; i < places; ++i) {
    EXPECT_LE(i, profile.at("fresnel_m").size());
    EXPECT_EQ(profile.at("ground_m")[i], profile.at("surface_m")[i]);
    const double clearance = profile.at("ray_m")[i].get<double>() - profile.at("surface_m")[i].get<double>();
    least = std::min(least, clearance);
  }
  EXPECT_NEAR(least, line.at("clearance_m").get<double>(), 0.01);
  EXPECT_NEAR(profile.at("fresnel_m").back().get<double>(), 0, 1e-6);
}

TEST_F(ServeHttp, TellsWhereAPlaceIsAndTheGroundThere) {
  const Json end = ask(*server_, "/api/v1/los?from=300500,171000,0&to=301800,171000,5").json().at("from");
  const Json place = ask(*server_, "/api/v1/place?at=300500,171000").json();
  for (const char* name : {"x", "y", "lon", "lat"}) EXPECT_DOUBLE_EQ(place.at(name), end.at(name)) << name;
  EXPECT_NEAR(place.at("ground_m").get<double>(), end.at("ground_m").get<double>(), 1e-9);
  EXPECT_EQ(place.at("grid_reference"), "ST 00500 71000");
  EXPECT_EQ(ask(*server_, "/api/v1/place?at=ST%2000500%2071000").json(), place);
  const auto expect = [&](const std::string& query, const std::string& error) {
    const Answer answer = ask(*server_, "/api/v1/place" + query);
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_NE(answer.json().at("error").get<std::string>().find(error), std::string::npos) << answer.body;
  };
  EXPECT_TRUE(place.at("height_m").is_null());
  EXPECT_EQ(ask(*server_, "/api/v1/place?at=300500,171000,40").json().at("height_m"), 40);
  expect("", "at: give a place");
  expect("?at=nowhere", "at 'nowhere': ");
  expect("?at=1,2", "off the data");
  expect("?at=300500,171000&radius=5", "radius: is not asked for here");
}

TEST_F(ServeHttp, HasProfilesOfTheCommandLine) {
  const Json profile =
      ask(*server_, "/api/v1/profile?from=300200,171000&to=301800,171000&tolerance=0&tolerance=4").json();
  const Json printed =
      Json::parse(shell_
                      .run("itin profile hill.itin --from 300200,171000 --to 301800,171000 --tolerance 0 "
                           "--tolerance 4 --json")
                      .out);
  EXPECT_EQ(profile.at("profiles"), printed.at("profiles"));
  EXPECT_EQ(profile.at("profiles").size(), 2u);
}

TEST_F(ServeHttp, RefusesWhatTheCommandLineRefuses) {
  const auto expect = [&](const std::string& target, const std::string& field, const std::string& error) {
    const Answer answer = ask(*server_, target);
    EXPECT_EQ(answer.status, 400) << target;
    EXPECT_NE(answer.json().at("error").get<std::string>().find(error), std::string::npos) << answer.body;
    EXPECT_EQ(answer.json().value("field", ""), field) << answer.body;
  };
  const std::string line = "/api/v1/los?from=300200,171000,5&to=301800,171000,5";
  expect("/api/v1/los", "", "give both ends");
  expect(line + "&refraction=much", "--refraction", "not a number");
  expect(line + "&refraction=", "--refraction", "its value is empty");
  expect(line + "&refrction=0.2", "", "unknown option '--refrction'; did you mean --refraction?");
  expect(line + "&--help=1", "", "is no name of an option");
  expect("/api/v1/los?from=1,2,5&to=301800,171000,5", "--from", "off the data");
  expect("/api/v1/profile?path=/etc/passwd", "--path", "names a file");
  expect("/api/v1/profile?from=300200,171000&to=301800,171000&output=x.csv", "--output", "names a file");
}

TEST_F(ServeHttp, HasTrianglesOfTheCommandLine) {
  const Answer window = ask(*server_, "/tin.glb?bbox=300500,170500,301500,171500&tolerance=1");
  ASSERT_EQ(window.status, 200) << window.body;
  EXPECT_EQ(window.headers.at("content-type"), "model/gltf-binary");
  shell_.run("itin tin hill.itin --bbox 300500,170500,301500,171500 --tolerance 1 -o window.glb");
  EXPECT_EQ(window.body, shell_.read("window.glb"));
  const auto expect = [&](const std::string& query, const std::string& error) {
    const Answer answer = ask(*server_, "/tin.glb?" + query);
    EXPECT_EQ(answer.status, 400) << query;
    EXPECT_NE(answer.json().at("error").get<std::string>().find(error), std::string::npos) << answer.body;
  };
  expect("", "--bbox: give xmin,ymin,xmax,ymax");
  expect("bbox=1,2,3", "--bbox");
  expect("bbox=300500,170500,301500,171500&tolerance=much", "--tolerance");
  expect("bbox=300500,170500,301500,171500&output=/tmp/x.glb", "--output: give bbox, tolerance and themes alone");
  expect("bbox=300500,170500,301500,171500&image=x.png", "--image: give");
}

TEST_F(ServeHttp, DescribesItself) {
  const Json api = ask(*server_, "/api/v1/openapi.json").json();
  EXPECT_EQ(api.at("openapi"), "3.1.0");
  for (const auto& [path, operations] : api.at("paths").items()) {
    if (!operations.contains("get") || path.find('{') != std::string::npos) continue;
    EXPECT_NE(ask(*server_, path).status, 404) << path;
  }
  EXPECT_TRUE(api.at("paths").at("/api/v1/jobs").contains("post"));
  EXPECT_TRUE(api.at("paths").at("/api/v1/uploads").contains("post"));
}

TEST_F(ServeHttp, OutlinesBuildings) {
  shell_.run(
      "itin import town.itin $DEMO/alexandria-dtm.tif --quiet && itin import town.itin --kind buildings "
      "--height-field HEIGHT $DEMO/alexandria-buildings.geojson --quiet");
  const ServedProgram town({(shell_.directory() / "town.itin").string()});
  const Json tiles = ask(town, "/api/v1/info").json().at("tiles");
  EXPECT_EQ(tiles.at("themes"), Json({"buildings"}));
  Json rings = Json::array();
  for (const char* tile : {"0/0/0", "0/1/0", "0/0/1", "0/1/1"}) {
    const Answer answer = ask(town, std::string("/tiles/theme/buildings/") + tile);
    if (answer.status != 200) continue;
    const Json found = answer.json();
    for (const Json& ring : found.at("rings")) rings.push_back(ring);
  }
  ASSERT_GT(rings.size(), 10u);
  for (const Json& ring : rings) {
    ASSERT_GE(ring.size(), 8u);
    EXPECT_EQ(ring[0], ring[ring.size() - 2]);
    EXPECT_EQ(ring[1], ring[ring.size() - 1]);
  }
}

}  // namespace

}  // namespace itin::test
