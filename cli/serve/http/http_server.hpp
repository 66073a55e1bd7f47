// HTTP and WebSockets on one port, by one thread; what is asked is answered by a few others.
//
//   HttpServer server({.host = "127.0.0.1", .port = 8080});
//   std::cout << server.port() << std::endl;
//   server.run(handler, progress);  // until progress is cancelled
//
// The source alone knows Boost.Beast, which compiles slowly.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <itin/progress.hpp>

#include "serve/http/http_message.hpp"

namespace itin::cli {

/// A WebSocket, to whoever writes to it. Safe for concurrent use; what is sent to one that has closed is dropped.
class LiveConnection {
 public:
  virtual ~LiveConnection() = default;
  virtual void send_text(std::string text) = 0;
  virtual void send_binary(std::string bytes) = 0;
  /// How many bytes wait for the client to read them.
  virtual std::size_t unsent() const = 0;
};

/// A WebSocket, to whoever reads it.
class LiveClient {
 public:
  virtual ~LiveClient() = default;
  /// Takes a text message, on the thread of the network, which it must not keep. Returns whether the connection may go
  /// on.
  virtual bool take(const std::string& text) = 0;
};

class HttpHandler {
 public:
  virtual ~HttpHandler() = default;
  /// Returns the answer to a request that is not to be answered, by its header alone; nothing for others. Called on the
  /// thread of the network, for WebSockets, too.
  virtual std::optional<HttpResponse> refusal(const HttpRequest& request) const = 0;
  /// How long the body of a request may be, on the thread of the network.
  virtual std::size_t most_bytes(const HttpRequest& request) const = 0;
  /// Called on any thread, at the same time as others. Throws nothing.
  virtual HttpResponse answer(const HttpRequest& request) = 0;
  /// Opens a WebSocket. The client lives as long as the connection.
  virtual std::unique_ptr<LiveClient> open(std::shared_ptr<LiveConnection> connection) = 0;
};

class HttpServer {
 public:
  struct Place {
    std::string host;
    std::uint16_t port = 0;  ///< 0: any that is free
  };

  /// Listens. Throws InputError where the host is not one of this machine, and Error where the port is taken.
  explicit HttpServer(const Place& place);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::uint16_t port() const;
  /// Whether only this machine can reach it.
  bool is_loopback() const;
  /// Serves until `progress` is cancelled, then throws Cancelled.
  void run(HttpHandler& handler, const Progress& progress);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace itin::cli
