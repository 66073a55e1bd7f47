#include "serve/http/http_server.hpp"

#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::cli {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using namespace std::chrono_literals;

constexpr std::size_t kMostConnections = 32;
/// Connections from one other machine. Programs on this one share an address, and a browser alone has seven.
constexpr std::size_t kMostFromOneAddress = 8;
constexpr std::size_t kAnsweringThreads = 4;
constexpr auto kTimeToAsk = 30s, kTimeToUpload = 120s;
constexpr int kMostLargeBodies = 2;
constexpr auto kTimeToSayHello = 10s;
/// How often the server looks whether it is to end, and how long clients have to hear that it does.
constexpr auto kBetweenLooks = 50ms, kTimeToPart = 100ms;

/// Counts connections. A seat is held by whoever has a copy of the pointer.
class Seats {
 public:
  using Seat = std::shared_ptr<const void>;

  /// Returns null where all are taken.
  Seat take(const asio::ip::address& address) {
    const std::lock_guard lock(mutex_);
    std::size_t& of_address = taken_[address];
    if (all_ >= kMostConnections || (!address.is_loopback() && of_address >= kMostFromOneAddress)) return nullptr;
    ++all_, ++of_address;
    return {this, [this, address](const void*) { give_back(address); }};
  }

 private:
  void give_back(const asio::ip::address& address) {
    const std::lock_guard lock(mutex_);
    --all_;
    if (--taken_[address] == 0) taken_.erase(address);
  }

  std::mutex mutex_;
  std::size_t all_ = 0;
  std::map<asio::ip::address, std::size_t> taken_;
};

class Socket;

/// What connections share. It outlives them.
struct Network {
  HttpHandler* handler = nullptr;
  asio::thread_pool answering{kAnsweringThreads};
  std::set<Socket*> sockets;  ///< the WebSockets that are open
  Seats seats;
  /// Whoever reads a large body has a copy, so that few do at once.
  std::shared_ptr<const int> large_bodies = std::make_shared<const int>(0);
};

std::string header_of(const http::request<http::string_body>& request, http::field name) {
  return std::string(request[name]);
}

/// A request without its body. Nothing for one that is malformed in a way that Beast lets pass.
std::optional<HttpRequest> understood(const http::request<http::string_body>& request) {
  const auto target = http_target({request.target().data(), request.target().size()});
  if (!target || !target->path.starts_with('/') || request.count(http::field::host) != 1) return std::nullopt;
  return HttpRequest{std::string(request.method_string()),
                     target->path,
                     target->query,
                     header_of(request, http::field::host),
                     header_of(request, http::field::origin),
                     std::string(request["X-Itin-Key"]),
                     header_of(request, http::field::content_type),
                     {}};
}

struct Message {
  std::string bytes;
  bool binary = false;
};

/// A WebSocket, on the thread of the network.
class Socket : public std::enable_shared_from_this<Socket> {
 public:
  Socket(beast::tcp_stream&& stream, Network& network, Seats::Seat seat)
      : network_(network),
        seat_(std::move(seat)),
        stream_(std::move(stream)),
        hello_(stream_.get_executor()),
        unsent_(std::make_shared<std::atomic<std::size_t>>(0)) {}
  ~Socket() { network_.sockets.erase(this); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void accept(const http::request<http::string_body>& request) {
    network_.sockets.insert(this);
    websocket::stream_base::timeout timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeouts.idle_timeout = 60s;
    timeouts.keep_alive_pings = true;
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(timeouts);
    stream_.read_message_max(kMostHttpBytes);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->begin();
    });
  }

  void send(Message message) {
    if (ended_) return drop(message);
    waiting_.push_back(std::move(message));
    if (waiting_.size() == 1) write();
  }

  /// Begins to part, which passes over what the client says meanwhile: nothing else may read then.
  void close(websocket::close_code code) {
    if (std::exchange(closing_, true)) return;
    stream_.async_close(code, [self = shared_from_this()](beast::error_code) { self->end(); });
  }

  /// Parts from the client, which ends elsewhere, for it waits for its work.
  void end() {
    if (std::exchange(ended_, true)) return;
    hello_.cancel();
    asio::post(network_.answering, [client = std::shared_ptr<LiveClient>(std::move(client_))] {});
  }

 private:
  void begin();

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      error ? self->end() : self->take();
    });
  }

  void take() {
    const std::string text = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    if (closing_) return;
    if (!stream_.got_text()) {
      close(websocket::close_code::unknown_data);
    } else if (client_->take(text)) {
      heard_ = true;
    } else {
      close(websocket::close_code::policy_error);
    }
    if (!closing_) read();
  }

  void write() {
    stream_.binary(waiting_.front().binary);
    stream_.async_write(asio::buffer(waiting_.front().bytes),
                        [self = shared_from_this()](beast::error_code error, std::size_t) { self->written(error); });
  }

  void written(beast::error_code error) {
    do {
      drop(waiting_.front());
      waiting_.pop_front();
    } while (error && !waiting_.empty());
    if (!waiting_.empty()) write();
  }

  void drop(const Message& message) { *unsent_ -= message.bytes.size(); }

  Network& network_;
  Seats::Seat seat_;
  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer hello_;
  beast::flat_buffer buffer_;
  std::unique_ptr<LiveClient> client_;
  std::deque<Message> waiting_;
  std::shared_ptr<std::atomic<std::size_t>> unsent_;
  bool heard_ = false, closing_ = false, ended_ = false;
};

/// Hands messages over to the thread of the network, which alone keeps the socket alive.
class Sender final : public LiveConnection {
 public:
  Sender(const std::shared_ptr<Socket>& socket, beast::tcp_stream::executor_type executor,
         std::shared_ptr<std::atomic<std::size_t>> unsent)
      : socket_(socket), executor_(std::move(executor)), unsent_(std::move(unsent)) {}

  void send_text(std::string text) override { send({std::move(text), false}); }
  void send_binary(std::string bytes) override { send({std::move(bytes), true}); }
  std::size_t unsent() const override { return *unsent_; }

 private:
  void send(Message message) {
    *unsent_ += message.bytes.size();
    asio::post(executor_, [to = socket_, message = std::move(message)]() mutable {
      if (const auto socket = to.lock()) socket->send(std::move(message));
    });
  }

  std::weak_ptr<Socket> socket_;
  beast::tcp_stream::executor_type executor_;
  std::shared_ptr<std::atomic<std::size_t>> unsent_;
};

void Socket::begin() {
  client_ = network_.handler->open(std::make_shared<Sender>(shared_from_this(), stream_.get_executor(), unsent_));
  hello_.expires_after(kTimeToSayHello);
  hello_.async_wait([self = shared_from_this()](beast::error_code error) {
    if (!error && !self->heard_) self->close(websocket::close_code::policy_error);
  });
  read();
}

/// A connection that asks by HTTP, until it asks for a WebSocket.
class Asker : public std::enable_shared_from_this<Asker> {
 public:
  /// Without a seat every request is refused.
  Asker(tcp::socket&& socket, Network& network, Seats::Seat seat)
      : network_(network), seat_(std::move(seat)), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHttpBytes);
    parser_->body_limit(kMostUploadBytes);
    stream_.expires_after(kTimeToAsk);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](beast::error_code error, std::size_t) {
                              error ? self->refuse(error) : self->take_header();
                            });
  }

 private:
  /// Answers what is no request; a connection that ended or was silent gets no answer.
  void refuse(beast::error_code error) {
    if (error == http::error::end_of_stream || error == http::error::partial_message) return part();
    if (error.category() != make_error_code(http::error::end_of_stream).category()) return;
    if (error == http::error::body_limit) return refuse_size(most_bytes_);
    if (error == http::error::header_limit)
      return write(http_failure(431, fmt::format("headers have at most {} bytes", kMostHttpBytes)), false);
    write(http_failure(400, "this is no request of HTTP"), false);
  }

  void refuse_size(std::size_t most) {
    write(http_failure(413, fmt::format("a request has at most {} bytes", most)), false);
  }

  /// Refuses by the header what is to be refused, before the body is read.
  void take_header() {
    const http::request<http::string_body>& asked = parser_->get();
    const bool keep = asked.keep_alive() && parser_->is_done();
    auto request = understood(asked);
    if (!request) return write(http_failure(400, "the request is malformed"), keep && seat_);
    request_ = std::move(*request);
    if (!seat_) return write(http_failure(429, "too many connections; close another page, or wait"), false);
    most_bytes_ = network_.handler->most_bytes(request_);
    if (parser_->content_length().value_or(0) > most_bytes_) return refuse_size(most_bytes_);
    if (auto refusal = network_.handler->refusal(request_)) return write(std::move(*refusal), keep);
    if (websocket::is_upgrade(asked)) return upgrade(request_.path);
    parser_->is_done() ? answer() : read_body();
  }

  void read_body() {
    if (most_bytes_ > kMostHttpBytes) {
      if (network_.large_bodies.use_count() > kMostLargeBodies)
        return write(http_failure(429, "other uploads are under way; try again later"), false);
      large_body_ = network_.large_bodies;
      stream_.expires_after(kTimeToUpload);
    }
    parser_->body_limit(most_bytes_);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      error ? self->refuse(error) : self->answer();
    });
  }

  void answer() {
    request_.body = std::move(parser_->get().body());
    stream_.expires_never();
    asio::post(network_.answering, [self = shared_from_this(), keep = parser_->get().keep_alive()]() mutable {
      HttpResponse response = self->network_.handler->answer(self->request_);
      const auto executor = self->stream_.get_executor();
      asio::post(executor, [self = std::move(self), response = std::move(response), keep]() mutable {
        self->request_ = {};
        self->large_body_.reset();
        self->write(std::move(response), keep);
      });
    });
  }

  void upgrade(const std::string& path) {
    if (path != "/live") return write(http_failure(404, "there is no WebSocket here"), false);
    std::make_shared<Socket>(std::move(stream_), network_, std::move(seat_))->accept(parser_->get());
  }

  void write(HttpResponse response, bool keep) {
    answer_ = {};
    answer_.version(11);
    answer_.result(static_cast<unsigned>(response.status));
    answer_.set(http::field::content_type, response.type);
    for (const auto& [name, value] : response.headers) answer_.set(name, value);
    answer_.body() = std::move(response.body);
    answer_.keep_alive(keep);
    answer_.prepare_payload();
    stream_.expires_after(kTimeToAsk);
    http::async_write(stream_, answer_, [self = shared_from_this(), keep](beast::error_code error, std::size_t) {
      if (error) return;
      keep ? self->read() : self->part();
    });
  }

  /// Closes once the client has closed, so that it reads the answer before it hears that the rest is not wanted.
  void part() {
    beast::error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(1s);
    stream_.async_read_some(asio::buffer(rest_), [self = shared_from_this()](beast::error_code error, std::size_t n) {
      if (!error && (self->drained_ += n) < 64 * kMostHttpBytes) self->part();
    });
  }

  Network& network_;
  Seats::Seat seat_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::size_t most_bytes_ = kMostHttpBytes;  ///< the longest body that is read
  HttpRequest request_;
  std::shared_ptr<const int> large_body_;
  http::response<http::string_body> answer_;
  std::array<char, 4096> rest_{};
  std::size_t drained_ = 0;
};

tcp::endpoint endpoint_of(asio::io_context& io, const HttpServer::Place& place) {
  beast::error_code error;
  const auto found = tcp::resolver(io).resolve(place.host, std::to_string(place.port), error);
  if (error || found.empty())
    throw InputError(fmt::format("--host '{}': is no address or name of this machine", place.host));
  return found.begin()->endpoint();
}

}  // namespace

class HttpServer::Impl {
 public:
  explicit Impl(const Place& place) : acceptor_(io_) {
    const tcp::endpoint endpoint = endpoint_of(io_, place);
    acceptor_.open(endpoint.protocol());
    acceptor_.set_option(tcp::acceptor::reuse_address(true));
    beast::error_code error;
    acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use)
      throw Error(fmt::format("--port {}: is taken on {}; give another one, or 0 for any that is free", place.port,
                              place.host));
    if (error == asio::error::access_denied)
      throw Error(fmt::format("--port {}: may not be used by you; give one above 1023", place.port));
    if (error) throw InputError(fmt::format("--host '{}': {}", place.host, error.message()));
  }

  tcp::endpoint endpoint() const { return acceptor_.local_endpoint(); }

  void run(HttpHandler& handler, const Progress& progress) {
    network_.handler = &handler;
    accept();
    look(progress);
    io_.run();
    end();
    throw Cancelled();
  }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error) return accept_later();
      beast::error_code gone;
      const tcp::endpoint client = socket.remote_endpoint(gone);
      // Tiles are small, and each is wanted at once.
      socket.set_option(tcp::no_delay(true), gone);
      if (!gone) std::make_shared<Asker>(std::move(socket), network_, network_.seats.take(client.address()))->read();
      accept();
    });
  }

  /// The process may have run out of files.
  void accept_later() {
    later_.expires_after(100ms);
    later_.async_wait([this](beast::error_code error) {
      if (!error) accept();
    });
  }

  void look(const Progress& progress) {
    look_.expires_after(kBetweenLooks);
    look_.async_wait([this, &progress](beast::error_code) { progress.cancelled() ? io_.stop() : look(progress); });
  }

  /// Tells those who are connected by WebSockets, and waits for what is being answered.
  void end() {
    acceptor_.close();
    for (Socket* socket : network_.sockets) socket->close(websocket::close_code::going_away);
    io_.restart();
    io_.run_for(kTimeToPart);
    for (Socket* socket : network_.sockets) socket->end();
    network_.answering.join();
  }

  Network network_;
  asio::io_context io_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer later_{io_}, look_{io_};
};

HttpServer::HttpServer(const Place& place) : impl_(std::make_unique<Impl>(place)) {}
HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
  return impl_->endpoint().port();
}
bool HttpServer::is_loopback() const {
  return impl_->endpoint().address().is_loopback();
}
void HttpServer::run(HttpHandler& handler, const Progress& progress) {
  impl_->run(handler, progress);
}

}  // namespace itin::cli
