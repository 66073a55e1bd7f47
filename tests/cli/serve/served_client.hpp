// HTTP and WebSockets over plain sockets, so that tests may send what no library would.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/serve/served_program.hpp"

namespace itin::test {

using Json = nlohmann::json;

/// How long tests wait for what must come: the machine may be busy.
constexpr std::chrono::minutes kPatience{4};

/// A connection to a port of this machine.
class ClientSocket {
 public:
  explicit ClientSocket(std::uint16_t port);
  ~ClientSocket();
  ClientSocket(const ClientSocket&) = delete;
  ClientSocket& operator=(const ClientSocket&) = delete;

  void send(std::string_view bytes);
  /// Says that nothing more will be sent.
  void finish();
  /// Reads until the text that has been read ends so; less where the server closes.
  std::string read_until(std::string_view end);
  /// Reads so many bytes; less where the server closes.
  std::string read(std::size_t bytes);
  std::string read_all();

 private:
  int socket_ = -1;
};

struct Answer {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;

  Json json() const { return Json::parse(body); }
};

/// Reads an answer whose header has its length.
Answer read_answer(ClientSocket& socket);

struct Ask {
  std::string method = "GET";
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::string body = {};
  std::optional<std::string> host = std::nullopt;  ///< the server's own
};
/// Asks by a connection of its own.
Answer ask(const ServedProgram& server, const std::string& target, const Ask& how = {});

/// The first 32 bytes of a tile, and what follows.
struct ReadTile {
  std::uint32_t seq = 0;
  int id = 0, step = 0, kind = 0;
  std::int32_t column = 0, row = 0;
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::uint8_t> verdicts;
  std::vector<float> values;  ///< float32, or uint16 as numbers
};
/// Reads all tiles of a message. Throws where they are not as PROTOCOL.md says.
std::vector<ReadTile> read_tiles(const std::string& message);

class WebSocketClient {
 public:
  enum Opcode { kText = 1, kBinary = 2, kClose = 8, kPing = 9, kPong = 10 };
  struct Frame {
    int opcode = 0;
    std::string payload;
    /// The code of a frame that closes.
    int code() const;
  };

  /// Shakes hands. Throws where the server does not.
  explicit WebSocketClient(const ServedProgram& server, const std::string& origin = {});
  /// Says hello with the right key, and waits for the welcome.
  static void welcome(WebSocketClient& client, const ServedProgram& server);

  void send(const Json& message) { send(kText, message.dump()); }
  void send(Opcode opcode, const std::string& payload) { socket_.send(frame_of(opcode, payload)); }
  void send_raw(std::string_view bytes) { socket_.send(bytes); }
  void finish() { socket_.finish(); }
  static std::string frame_of(Opcode opcode, const std::string& payload);
  /// The next frame that is no ping; nothing where the server has hung up.
  std::optional<Frame> read();
  /// The next text message of this type; others go by. Throws where none comes.
  Json read_until(const std::string& type);

 private:
  ClientSocket socket_;
};

}  // namespace itin::test
