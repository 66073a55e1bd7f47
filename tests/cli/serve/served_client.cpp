#include "cli/serve/served_client.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <netinet/in.h>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

namespace itin::test {

namespace {

std::string in_lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

template <class Value>
Value value_at(const std::string& bytes, std::size_t at) {
  Value value{};
  if (at + sizeof value > bytes.size()) throw std::runtime_error("a tile ends early");
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::size_t aligned(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

ReadTile read_tile(const std::string& message, std::size_t begin) {
  ReadTile tile;
  tile.seq = value_at<std::uint32_t>(message, begin + 4);
  tile.id = value_at<std::uint16_t>(message, begin + 8);
  tile.step = value_at<std::uint8_t>(message, begin + 10);
  tile.kind = value_at<std::uint8_t>(message, begin + 11);
  tile.column = value_at<std::int32_t>(message, begin + 12);
  tile.row = value_at<std::int32_t>(message, begin + 16);
  tile.columns = value_at<std::uint32_t>(message, begin + 20);
  tile.rows = value_at<std::uint32_t>(message, begin + 24);
  const std::size_t cells = std::size_t{tile.columns} * tile.rows, verdicts = begin + 32;
  const std::size_t values = verdicts + aligned(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    tile.verdicts.push_back(value_at<std::uint8_t>(message, verdicts + i));
    if (tile.kind == 1) tile.values.push_back(value_at<std::uint16_t>(message, values + 2 * i));
    if (tile.kind == 2) tile.values.push_back(value_at<float>(message, values + 4 * i));
  }
  const std::size_t end = values + aligned(tile.kind == 0 ? 0 : cells * (tile.kind == 1 ? 2 : 4));
  if (value_at<std::uint32_t>(message, begin) != end - begin) throw std::runtime_error("a tile tells a wrong size");
  return tile;
}

}  // namespace

ClientSocket::ClientSocket(std::uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const timeval patience{std::chrono::seconds(kPatience).count(), 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("not connected");
}

ClientSocket::~ClientSocket() {
  close(socket_);
}

void ClientSocket::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // the server has hung up, as the answer will tell
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
}

void ClientSocket::finish() {
  shutdown(socket_, SHUT_WR);
}

std::string ClientSocket::read_until(std::string_view end) {
  std::string text;
  for (char c = 0; !text.ends_with(end) && recv(socket_, &c, 1, 0) == 1;) text += c;
  return text;
}

std::string ClientSocket::read(std::size_t bytes) {
  std::string read(bytes, '\0');
  std::size_t got = 0;
  for (ssize_t n = 0; got < bytes && (n = recv(socket_, read.data() + got, bytes - got, 0)) > 0;)
    got += static_cast<std::size_t>(n);
  read.resize(got);
  return read;
}

std::string ClientSocket::read_all() {
  std::string all;
  for (std::string more; !(more = read(4096)).empty();) all += more;
  return all;
}

Answer read_answer(ClientSocket& socket) {
  Answer answer;
  std::string head = socket.read_until("\r\n\r\n");
  if (!head.starts_with("HTTP/1.1 ")) throw std::runtime_error("no answer: " + head);
  answer.status = std::stoi(head.substr(9, 3));
  for (std::size_t at = head.find("\r\n") + 2; at + 2 < head.size();) {
    const std::size_t end = head.find("\r\n", at), colon = head.find(": ", at);
    answer.headers[in_lower(head.substr(at, colon - at))] = head.substr(colon + 2, end - colon - 2);
    at = end + 2;
  }
  if (answer.headers.contains("content-length"))
    answer.body = socket.read(std::stoul(answer.headers.at("content-length")));
  return answer;
}

Answer ask(const ServedProgram& server, const std::string& target, const Ask& how) {
  ClientSocket socket(server.port());
  std::string request = how.method + " " + target + " HTTP/1.1\r\nHost: " + how.host.value_or(server.host()) + "\r\n";
  for (const auto& [name, value] : how.headers) request += name + ": " + value + "\r\n";
  if (!how.body.empty()) request += "Content-Length: " + std::to_string(how.body.size()) + "\r\n";
  socket.send(request + "\r\n" + how.body);
  return read_answer(socket);
}

std::vector<ReadTile> read_tiles(const std::string& message) {
  std::vector<ReadTile> tiles;
  for (std::size_t at = 0; at < message.size(); at += value_at<std::uint32_t>(message, at))
    tiles.push_back(read_tile(message, at));
  return tiles;
}

int WebSocketClient::Frame::code() const {
  return payload.size() < 2 ? 0 : static_cast<unsigned char>(payload[0]) * 256 + static_cast<unsigned char>(payload[1]);
}

WebSocketClient::WebSocketClient(const ServedProgram& server, const std::string& origin) : socket_(server.port()) {
  std::string request = "GET /live HTTP/1.1\r\nHost: " + server.host() +
                        "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  if (!origin.empty()) request += "Origin: " + origin + "\r\n";
  socket_.send(request + "\r\n");
  const Answer answer = read_answer(socket_);
  if (answer.status != 101) throw std::runtime_error("no WebSocket: " + std::to_string(answer.status));
}

void WebSocketClient::welcome(WebSocketClient& client, const ServedProgram& server) {
  client.send(Json{{"type", "hello"}, {"key", server.key()}});
  client.read_until("welcome");
}

std::string WebSocketClient::frame_of(Opcode opcode, const std::string& payload) {
  std::string frame(1, static_cast<char>(0x80 | opcode));
  if (payload.size() < 126) {
    frame += static_cast<char>(0x80 | payload.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(payload.size() >> 8);
    frame += static_cast<char>(payload.size() & 0xff);
  }
  // The mask is zero, which is a mask.
  return frame + std::string(4, '\0') + payload;
}

std::optional<WebSocketClient::Frame> WebSocketClient::read() {
  while (true) {
    const std::string head = socket_.read(2);
    if (head.size() < 2) return std::nullopt;
    std::size_t size = static_cast<unsigned char>(head[1]) & 0x7f;
    const std::size_t bytes_of_size = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (bytes_of_size > 0) size = 0;
    for (const char byte : socket_.read(bytes_of_size)) size = size * 256 + static_cast<unsigned char>(byte);
    Frame frame{head[0] & 0x0f, socket_.read(size)};
    if (frame.opcode != kPing) return frame;
    send(kPong, frame.payload);
  }
}

Json WebSocketClient::read_until(const std::string& type) {
  while (const auto frame = read()) {
    if (frame->opcode != kText) continue;
    Json message = Json::parse(frame->payload);
    if (message.at("type") == type) return message;
    if (message.at("type") == "error") throw std::runtime_error(message.dump());
  }
  throw std::runtime_error("no message " + type);
}

}  // namespace itin::test
