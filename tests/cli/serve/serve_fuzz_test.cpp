// Requests, frames and messages that are damaged at random: the server lives on, whatever it is sent. ctest runs this
// under the address and undefined-behaviour sanitizers, too.
#include <random>

#include <gtest/gtest.h>

#include "cli/serve/served_hill.hpp"
#include "support/seed.hpp"

namespace itin::test {

namespace {

class ServeFuzz : public ServedHill {
 protected:
  std::size_t below(std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_); }

  /// The text with a few places changed, left out, repeated, or with odd pieces put in.
  std::string damaged(std::string text) {
    static const std::vector<std::string> kPieces = {"\0",  "\r\n",  "%",    "\"",  "{",    "]",    ",",   "-",
                                                     "1e9", "1e400", "0.01", "nan", "\xff", "null", "true"};
    for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
      const std::size_t at = below(text.size()), length = std::min(text.size() - at, 1 + below(8));
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, text.substr(at, length));
          break;
        default:
          text.insert(at, kPieces[below(kPieces.size())]);
      }
    }
    return text;
  }

  std::mt19937_64 random_{seed()};
};

TEST_F(ServeFuzz, LivesOnAfterDamagedRequests) {
  const std::string rest = " HTTP/1.1\r\nHost: " + server_->host() + "\r\n";
  const std::string key = "X-Itin-Key: " + server_->key() + "\r\n";
  const std::string job = R"({"verb": "los", "options": {"from": "300200,171000,5", "to": "301800,171000"}})";
  const std::vector<std::string> requests = {
      "GET /" + rest + "\r\n",
      "GET /api/v1/info" + rest + "Origin: http://" + server_->host() + "\r\n\r\n",
      "GET /api/v1/los?from=300200,171000,5&to=301800,171000,5&frequency=7.5&criterion=4/3,1" + rest + "\r\n",
      "GET /api/v1/profile?from=300200,171000&to=301800,171000&tolerance=2" + rest + "\r\n",
      "GET /tiles/heights/0/0/0?v=1" + rest + "\r\n",
      "GET /live" + rest + "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n\r\n",
      "GET /api/v1/jobs/0123/../../x" + rest + "\r\n",
      "POST /api/v1/jobs" + rest + key +
          "Content-Type: application/json\r\nContent-Length: " + std::to_string(job.size()) + "\r\n\r\n" + job,
      "POST /api/v1/uploads" + rest + key +
          "Content-Type: text/csv\r\nContent-Length: 22\r\n\r\nx,y\n301000,171000\n1,2\n"};
  for (int i = 0; i < 300; ++i) {
    ClientSocket socket(server_->port());
    socket.send(damaged(requests[below(requests.size())]));
    socket.finish();
    socket.read_all();
  }
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
}

TEST_F(ServeFuzz, LivesOnAfterDamagedMessages) {
  const std::vector<std::string> messages = {
      R"({"type":"view","id":1,"seq":1,"options":{"observer":"301000,171000,5","radius":"900","cell":25,"mode":"height"}})",
      R"({"type":"view","id":2,"seq":1,"options":{"observer":["301000,171000,5","300500,171000"],"mode":"count","cell":25}})",
      R"({"type":"view","id":3,"seq":2,"options":{"observer":"301000,171000,5","cell":25,"frequency":5,"target-height":9}})",
      R"({"type":"move","id":1,"seq":2,"observer":"300900,171000,5"})",
      R"({"type":"probe","id":1,"seq":3,"x":300500,"y":171500})",
      R"({"type":"line","id":4,"seq":1,"options":{"from":"300200,171000,5","to":"301800,171000,3","frequency":"2"}})",
      R"({"type":"stop","id":1})"};
  for (int i = 0; i < 40; ++i) {
    WebSocketClient client(*server_);
    WebSocketClient::welcome(client, *server_);
    for (const std::string& message : messages) client.send(WebSocketClient::kText, damaged(message));
    for (int k = 0; k < 5; ++k)
      client.send_raw(damaged(WebSocketClient::frame_of(WebSocketClient::kText, messages[below(messages.size())])));
    client.finish();
    while (client.read()) {
    }
  }
  EXPECT_EQ(ask(*server_, "/api/v1/info").status, 200);
}

}  // namespace

}  // namespace itin::test
