// A client's WebSocket: its messages, and what becomes of them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include <itin/document.hpp>

#include "serve/ground/served_store.hpp"
#include "serve/http/http_server.hpp"
#include "serve/live/latest_work.hpp"
#include "serve/live/live_probe.hpp"
#include "serve/live/live_tile.hpp"

namespace itin::cli {

class LiveMap final : public LiveClient {
 public:
  /// `served` must outlive the map.
  LiveMap(ServedStore& served, std::string key, std::shared_ptr<LiveConnection> connection);

  bool take(const std::string& text) override;

 private:
  bool take_hello(const Document& message);
  void take(const std::string& type, const LiveNumber& number, const Document& message);
  void view(const LiveNumber& number, const Document& message);
  void move(const LiveNumber& number, const Document& message);
  void show(const LiveNumber& number);
  void stop(const LiveNumber& number);
  void probe(const LiveNumber& number, const Document& message);
  void line(const LiveNumber& number, const Document& message);
  const Document& options_of(const LiveNumber& number) const;

  ServedStore& served_;
  LiveProbe probe_;
  std::string key_;
  std::shared_ptr<LiveConnection> connection_;
  bool welcome_ = false;
  std::map<std::uint16_t, Document> views_;  ///< options by id
  LatestWork drawing_, asking_;              ///< views; probes and lines
};

}  // namespace itin::cli
