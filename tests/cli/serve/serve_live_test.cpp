// Live views, probes and lines, by WebSocket.
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <itin/raster.hpp>

#include "cli/serve/served_hill.hpp"

namespace itin::test {

namespace {

/// What a client knows of a view's cells, by their places in the grid of all cells.
class SeenCells {
 public:
  using Place = std::pair<std::int64_t, std::int64_t>;  ///< column, row

  void add(const ReadTile& tile) {
    ++tiles_[tile.step];
    for (std::uint32_t row = 0; row < tile.rows; ++row) {
      for (std::uint32_t column = 0; column < tile.columns; ++column) {
        const std::size_t i = std::size_t{row} * tile.columns + column;
        const Place place{tile.column + std::int64_t{column} * tile.step, tile.row + std::int64_t{row} * tile.step};
        add(place, verdicts_, tile.verdicts[i]);
        if (tile.kind != 0) add(place, values_, tile.values[i]);
      }
    }
  }

  int tiles(int step) const { return tiles_.contains(step) ? tiles_.at(step) : 0; }
  int verdict(Place place) const { return verdicts_.contains(place) ? verdicts_.at(place) : 255; }
  float value(Place place) const { return values_.contains(place) ? values_.at(place) : NAN; }

 private:
  /// A later pass repeats what earlier ones said.
  template <class Value>
  static void add(Place place, std::map<Place, Value>& known, Value value) {
    const auto [before, is_new] = known.emplace(place, value);
    if (is_new || (std::isnan(static_cast<float>(value)) && std::isnan(static_cast<float>(before->second)))) return;
    EXPECT_EQ(before->second, value) << place.first << ',' << place.second;
  }

  std::map<int, int> tiles_;
  std::map<Place, std::uint8_t> verdicts_;
  std::map<Place, float> values_;
};

/// The values of a raster of one band, NaN where there are none.
std::vector<double> values_of(const std::string& path) {
  const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  if (!file) throw std::runtime_error("no raster " + path);
  std::vector<double> values(static_cast<std::size_t>(file->GetRasterXSize()) *
                             static_cast<std::size_t>(file->GetRasterYSize()));
  GDALRasterBand& band = *file->GetRasterBand(1);
  const CPLErr error = band.RasterIO(GF_Read, 0, 0, file->GetRasterXSize(), file->GetRasterYSize(), values.data(),
                                     file->GetRasterXSize(), file->GetRasterYSize(), GDT_Float64, 0, 0);
  if (error != CE_None) throw std::runtime_error("no values in " + path);
  int has_nodata = 0;
  const double nodata = band.GetNoDataValue(&has_nodata);
  for (double& value : values)
    if (has_nodata != 0 && value == nodata) value = NAN;
  return values;
}

class ServeLive : public ServedHill {
 protected:
  Json view(int seq, const Json& options) const {
    return {{"type", "view"}, {"id", 1}, {"seq", seq}, {"options", options}};
  }

  /// Reads until the view is done, and returns what is said then.
  static Json read_view(WebSocketClient& client, SeenCells& cells, Json* begun = nullptr) {
    while (const auto frame = client.read()) {
      if (frame->opcode == WebSocketClient::kBinary) {
        EXPECT_EQ(frame->payload.size() % 4, 0u);
        for (const ReadTile& tile : read_tiles(frame->payload)) cells.add(tile);
        continue;
      }
      Json message = Json::parse(frame->payload);
      if (message.at("type") == "begun" && begun != nullptr) *begun = message;
      if (message.at("type") != "begun") return message;
    }
    throw std::runtime_error("the server hung up");
  }

  /// Compares a view with the raster that its command line writes. `outside` is what a cell without a value has.
  void expect_same_as_raster(const Json& options, bool compare_values, float outside) {
    WebSocketClient client(*server_);
    WebSocketClient::welcome(client, *server_);
    client.send(view(7, options));
    SeenCells seen;
    Json begun;
    const Json done = read_view(client, seen, &begun);
    ASSERT_EQ(done.at("type"), "done") << done;
    EXPECT_EQ(done.at("seq"), 7);
    for (const int step : {9, 3, 1}) EXPECT_GT(seen.tiles(step), 0) << step;
    const Outcome outcome = shell_.run("rm -f viewshed.*; " + done.at("command").get<std::string>() + " --json");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json printed = Json::parse(outcome.out);
    for (const char* name : {"cells", "area_m2", "share_without_data", "warnings", "grid"})
      EXPECT_EQ(done.at(name), printed.at(name)) << name;
    const std::string path = (shell_.directory() / "viewshed.tif").string();
    const RasterGrid grid = raster_grid_like(path, "");
    const std::vector<double> values = values_of(path);
    ASSERT_EQ(begun.at("columns"), grid.columns());
    ASSERT_EQ(begun.at("rows"), grid.rows());
    const std::int64_t column0 = begun.at("column"), row0 = begun.at("row");
    EXPECT_EQ(static_cast<double>(column0) * begun.at("cell_m").get<double>(), grid.north_west().x);
    EXPECT_EQ(static_cast<double>(-row0) * begun.at("cell_m").get<double>(), grid.north_west().y);
    int told = 0;
    for (std::int64_t row = 0; row < grid.rows(); ++row) {
      for (std::int64_t column = 0; column < grid.columns(); ++column) {
        const double written = values[grid.index({column, row})];
        const SeenCells::Place place{column0 + column, row0 + row};
        const float expected = std::isnan(written) ? outside : static_cast<float>(written);
        const float found = compare_values ? seen.value(place) : static_cast<float>(seen.verdict(place));
        told += std::isnan(written) ? 0 : 1;
        // Cells that nobody looks at are not told.
        if (compare_values && std::isnan(found) && seen.verdict(place) == 255) continue;
        EXPECT_TRUE(found == expected || (std::isnan(found) && std::isnan(expected)))
            << column << ',' << row << ": " << found << ", not " << expected;
      }
    }
    EXPECT_GT(told, 1000);
  }
};

TEST_F(ServeLive, HasTheBytesOfTheCommandLine) {
  const Json options = {{"observer", "301000,171000,5"}, {"radius", "900"}, {"cell", 12.5}, {"target-height", "1.5"}};
  expect_same_as_raster(options, false, 255);
  for (const char* mode : {"height", "angle"}) {
    Json of_mode = options;
    of_mode["mode"] = mode;
    expect_same_as_raster(of_mode, true, NAN);
  }
  Json count = options;
  count["mode"] = "count";
  count["observer"] = {"301000,171000,5", "301400,171000,2"};
  expect_same_as_raster(count, true, 65535);
}

TEST_F(ServeLive, FollowsRadioAndFieldsOfView) {
  expect_same_as_raster({{"observer", "301000,171000,5"},
                         {"cell", 12.5},
                         {"frequency", 7.5},
                         {"target-height", 20},
                         {"effective-earth", "4/3"}},
                        false, 255);
  expect_same_as_raster({{"observer", "300400,171000,5"}, {"cell", 12.5}, {"azimuth", "20,160"}, {"nodata", "block"}},
                        false, 255);
}

TEST_F(ServeLive, MovesAViewAndObeysTheLatest) {
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  client.send(view(1, {{"observer", "300500,171000,5"}, {"cell", 5}}));
  constexpr int kLast = 40;
  for (int seq = 2; seq <= kLast; ++seq)
    client.send(
        {{"type", "move"}, {"id", 1}, {"seq", seq}, {"observer", fmt::format("{},171000,5", 300500 + 10 * seq)}});
  std::set<int> begun, done;
  std::map<int, std::set<int>> steps;
  while (!done.contains(kLast)) {
    const auto frame = client.read();
    ASSERT_TRUE(frame);
    if (frame->opcode == WebSocketClient::kBinary) {
      for (const ReadTile& tile : read_tiles(frame->payload)) steps[static_cast<int>(tile.seq)].insert(tile.step);
      continue;
    }
    const Json message = Json::parse(frame->payload);
    ASSERT_NE(message.at("type"), "error") << message;
    (message.at("type") == "done" ? done : begun).insert(message.at("seq").get<int>());
  }
  EXPECT_LT(done.size(), static_cast<std::size_t>(kLast));
  // What was begun has shown its first pass.
  for (const int seq : begun) EXPECT_TRUE(steps[seq].contains(9)) << seq;
  for (const int seq : done) EXPECT_TRUE(steps[seq].contains(1)) << seq;
}

TEST_F(ServeLive, ShowsSeveralViewsAndStopsThem) {
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  const Json options = {{"observer", "300500,171000,5"}, {"cell", 50}};
  for (int id = 0; id < 32; ++id) client.send({{"type", "view"}, {"id", id}, {"seq", 1}, {"options", options}});
  std::set<int> done;
  while (done.size() < 32) done.insert(client.read_until("done").at("id").get<int>());
  client.send({{"type", "view"}, {"id", 32}, {"seq", 2}, {"options", options}});
  EXPECT_THROW(client.read_until("done"), std::runtime_error);
  client.send({{"type", "stop"}, {"id", 5}});
  client.send({{"type", "view"}, {"id", 32}, {"seq", 3}, {"options", options}});
  EXPECT_EQ(client.read_until("done").at("seq"), 3);
  client.send({{"type", "move"}, {"id", 5}, {"seq", 4}, {"observer", "300500,171000,5"}});
  EXPECT_THROW(client.read_until("done"), std::runtime_error);
}

TEST_F(ServeLive, TellsWhatIsWrongAndGoesOn) {
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  const auto expect = [&](const Json& message, const std::string& of, const std::string& field,
                          const std::string& error) {
    client.send(message);
    const auto frame = client.read();
    ASSERT_TRUE(frame);
    const Json told = Json::parse(frame->payload);
    EXPECT_EQ(told.at("type"), "error") << told;
    EXPECT_EQ(told.at("of"), of) << told;
    EXPECT_EQ(told.value("field", ""), field) << told;
    EXPECT_NE(told.at("error").get<std::string>().find(error), std::string::npos) << told;
  };
  const auto expect_view = [&](const Json& options, const std::string& field, const std::string& error) {
    expect(view(1, options), "view", field, error);
  };
  const std::string hill = "301000,171000,5";
  expect_view({{"observer", "1,2,3"}}, "--observer", "off the data");
  expect_view(Json::object(), "", "--observer");
  expect_view({{"observer", hill}, {"radius", "0"}}, "--radius", "");
  expect_view({{"observer", hill}, {"radius", Json::array({Json::object()})}}, "--radius", "expected a text");
  expect_view({{"observer", hill}, {"cell", 1000000}, {"radius", 500}}, "--cell", "larger than the radius");
  expect_view({{"observer", hill}, {"cell", 0.05}}, "--cell", "too many for a live view");
  expect_view({{"observer", hill}, {"mode", "which"}}, "--mode", "visible, count, angle, height, probability");
  expect_view({{"observer", hill}, {"mode", "certified"}}, "--mode", "live views have");
  expect_view({{"observer", hill}, {"rings", "100:1"}}, "--rings", "one tolerance");
  expect_view({{"observer", hill}, {"themes", "trees"}}, "", "trees");
  expect_view({{"observers", "/etc/passwd"}}, "--observers", "names a file");
  expect_view({{"observer", hill}, {"like", "/etc/passwd"}}, "--like", "names a file");
  expect_view({{"observer", hill}, {"output", "x.tif"}}, "", "unknown option '--output'");
  expect({{"type", "view"}, {"id", 1}, {"seq", 1}}, "view", "", "'options' must be an object");
  expect({{"type", "view"}, {"id", 70000}, {"seq", 1}}, "view", "", "'id' must be a whole number");
  expect({{"type", "view"}, {"id", 1}, {"seq", -1}}, "view", "", "'seq' must be a whole number");
  expect({{"type", "move"}, {"id", 9}, {"seq", 1}}, "move", "", "there is no view 9");
  expect({{"type", "dance"}, {"id", 1}, {"seq", 1}}, "dance", "", "there is no message 'dance'");
  expect({{"id", 1}, {"seq", 1}}, "", "", "there is no message ''");
  client.send(view(2, {{"observer", hill}, {"cell", 50}}));
  EXPECT_EQ(client.read_until("done").at("seq"), 2);
}

TEST_F(ServeLive, HangsUpOnWhatIsNoClient) {
  const std::string hello = Json{{"type", "hello"}, {"key", server_->key()}}.dump();
  const auto code = [&](const std::string& frames, bool after_hello) {
    WebSocketClient client(*server_);
    if (after_hello) WebSocketClient::welcome(client, *server_);
    client.send_raw(frames);
    const auto frame = client.read();
    return !frame ? 0 : frame->opcode == WebSocketClient::kClose ? frame->code() : -1;
  };
  const auto text = [](int first, const std::string& payload) {
    return std::string(1, static_cast<char>(first)) + static_cast<char>(0x80 | payload.size()) + std::string(4, '\0') +
           payload;
  };
  EXPECT_EQ(code(text(0x81, R"({"type":"hello","key":"0123"})"), false), 1008);
  EXPECT_EQ(code(text(0x81, R"({"type":"view","id":1,"seq":1})"), false), 1008);
  EXPECT_EQ(code(text(0x81, "{"), false), 1008);
  EXPECT_EQ(code(text(0x81, "[1]"), true), 1008);
  EXPECT_EQ(code(text(0x81, "\xff\xfe"), true), 1007);
  EXPECT_EQ(code(text(0x82, "{}"), true), 1003);
  EXPECT_EQ(code(text(0x83, "{}"), true), 1002);                            // an unknown kind
  EXPECT_EQ(code(text(0xf1, "{}"), true), 1002);                            // reserved bits
  EXPECT_EQ(code(std::string("\x81\x02{}", 4), true), 1002);                // no mask
  EXPECT_EQ(code(std::string("\x81\xfe\x40\x01\0\0\0\0", 8), true), 1009);  // 16385 bytes
  EXPECT_EQ(code(std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14), true), 1009);
  WebSocketClient nested(*server_);
  WebSocketClient::welcome(nested, *server_);
  nested.send(WebSocketClient::kText, std::string(16000, '['));
  EXPECT_EQ(nested.read()->code(), 1008);
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
}

TEST_F(ServeLive, LivesOnWhenClientsGo) {
  for (int i = 0; i < 5; ++i) {
    WebSocketClient client(*server_);
    WebSocketClient::welcome(client, *server_);
    client.send(view(1, {{"observer", "301000,171000,5"}, {"cell", 1}, {"mode", "height"}}));
    if (i > 0) client.read_until("begun");
  }
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  client.send(view(2, {{"observer", "301000,171000,5"}, {"cell", 50}}));
  EXPECT_EQ(client.read_until("done").at("seq"), 2);
  client.send(view(3, {{"observer", "301000,171000,5"}, {"cell", 1}, {"mode", "height"}}));
  client.read_until("begun");
  EXPECT_EQ(server_->end(SIGINT).status, 130);
}

TEST_F(ServeLive, WaitsForNoSlowClient) {
  WebSocketClient slow(*server_);
  WebSocketClient::welcome(slow, *server_);
  const Json options = {{"observer", "301000,171000,5"}, {"cell", 2}, {"mode", "height"}};
  for (int id = 0; id < 4; ++id) slow.send({{"type", "view"}, {"id", id}, {"seq", 1}, {"options", options}});
  std::this_thread::sleep_for(std::chrono::seconds(2));
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  client.send(view(2, {{"observer", "301000,171000,5"}, {"cell", 50}}));
  EXPECT_EQ(client.read_until("done").at("seq"), 2);
  // It gets everything in the end.
  for (int done = 0; done < 4; ++done) slow.read_until("done");
}

TEST_F(ServeLive, ProbesAsLinesOfSight) {
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  client.send(view(1, {{"observer", "300200,171000,5"}, {"target-height", 3}, {"cell", 50}}));
  client.read_until("done");
  client.send({{"type", "probe"}, {"id", 1}, {"seq", 2}, {"x", 301800}, {"y", 171000}});
  const Json hidden = client.read_until("probe");
  EXPECT_EQ(hidden.at("seq"), 2);
  const Json los = ask(*server_, "/api/v1/los?from=300200,171000,5&to=301800,171000,3").json();
  EXPECT_EQ(hidden.at("verdict"), "hidden");
  EXPECT_EQ(hidden.at("distance_m"), 1600);
  EXPECT_EQ(hidden.at("azimuth_deg"), 90);
  EXPECT_EQ(hidden.at("back_azimuth_deg"), 270);
  EXPECT_EQ(hidden.at("ground_m"), los.at("to").at("ground_m"));
  EXPECT_EQ(hidden.at("clearance_m"), los.at("clearance_m"));
  EXPECT_EQ(hidden.at("blocker").at("what"), "terrain");
  EXPECT_EQ(hidden.at("blocker").at("x"), los.at("obstructions")[0].at("peak_at_m").get<double>() + 300200);
  // A target that much higher is seen, one a little less high is not.
  const double lacks = hidden.at("lacks_m");
  EXPECT_GT(lacks, 1);
  const auto verdict = [&](double height) {
    return ask(*server_, fmt::format("/api/v1/los?from=300200,171000,5&to=301800,171000,{}", height))
        .json()
        .at("verdict");
  };
  EXPECT_EQ(verdict(3 + lacks + 0.001), "visible");
  EXPECT_EQ(verdict(3 + lacks - 0.001), "hidden");
  client.send({{"type", "probe"}, {"id", 1}, {"seq", 3}, {"x", 300300}, {"y", 171000}});
  const Json seen = client.read_until("probe");
  EXPECT_EQ(seen.at("lacks_m"), 0);
  EXPECT_EQ(seen.at("blocker"), nullptr);
  client.send({{"type", "probe"}, {"id", 1}, {"seq", 4}, {"x", 0}, {"y", 0}});
  EXPECT_THROW(client.read_until("probe"), std::runtime_error);
}

TEST_F(ServeLive, DrawsLines) {
  WebSocketClient client(*server_);
  WebSocketClient::welcome(client, *server_);
  const Json options = {{"from", "300200,171000,5"}, {"to", "301800,171000,3"}, {"frequency", 2}};
  client.send({{"type", "line"}, {"id", 3}, {"seq", 1}, {"options", options}});
  const Json line = client.read_until("line");
  EXPECT_EQ(line.at("id"), 3);
  EXPECT_EQ(line.at("profile"),
            ask(*server_, "/api/v1/los?from=300200,171000,5&to=301800,171000,3&frequency=2").json().at("profile"));
}

}  // namespace

}  // namespace itin::test
