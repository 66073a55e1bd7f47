// A server on this machine that answers every request with "not found" and counts them.
#pragma once

#include <array>
#include <atomic>
#include <netinet/in.h>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace itin::test {

class Listener {
 public:
  Listener() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (socket_ < 0 || bind(socket_, any, size) != 0 || listen(socket_, 64) != 0 ||
        getsockname(socket_, any, &size) != 0)
      throw std::runtime_error("no server on 127.0.0.1");
    port_ = std::to_string(ntohs(address.sin_port));
    server_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  ~Listener() {
    server_.request_stop();
    server_.join();
    close(socket_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  const std::string& port() const { return port_; }
  std::string address() const { return "http://127.0.0.1:" + port_; }

  /// Returns the number of connections since the last call, once all that were made are answered.
  int take_connections() {
    while (is_waiting(socket_, 0)) std::this_thread::yield();
    return connections_.exchange(0);
  }

 private:
  static bool is_waiting(int socket, int milliseconds) {
    pollfd wanted{socket, POLLIN, 0};
    return poll(&wanted, 1, milliseconds) > 0;
  }

  void serve(const std::stop_token& stop) {
    constexpr std::string_view kAnswer = "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
    while (!stop.stop_requested()) {
      if (!is_waiting(socket_, 20)) continue;
      ++connections_;
      const int connection = accept(socket_, nullptr, nullptr);
      std::array<char, 4096> request{};
      if (is_waiting(connection, 300) && recv(connection, request.data(), request.size(), 0) > 0)
        send(connection, kAnswer.data(), kAnswer.size(), MSG_NOSIGNAL);
      close(connection);
    }
  }

  int socket_ = socket(AF_INET, SOCK_STREAM, 0);
  std::string port_;
  std::atomic<int> connections_ = 0;
  std::jthread server_;
};

}  // namespace itin::test
