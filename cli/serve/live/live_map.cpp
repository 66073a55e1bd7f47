#include "serve/live/live_map.hpp"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>

#include "serve/calls/admission.hpp"
#include "serve/ground/given_options.hpp"
#include "serve/ground/los_answer.hpp"
#include "serve/http/failure.hpp"
#include "serve/live/live_view.hpp"

namespace itin::cli {

namespace {

constexpr std::size_t kMostViews = 32;
/// Lines have the keys of their numbers; the one probe has another.
constexpr std::uint32_t kProbeKey = 1U << 16;

template <class Number>
Number whole_member(const Document& message, const char* name) {
  const auto value = message.find(name);
  if (value == message.end() || !value->is_number_unsigned() ||
      value->get<std::uint64_t>() > std::numeric_limits<Number>::max())
    throw InputError(fmt::format("'{}' must be a whole number from 0 to {}", name, std::numeric_limits<Number>::max()));
  return value->get<Number>();
}

double number_member(const Document& message, const char* name) {
  const auto value = message.find(name);
  if (value == message.end() || !value->is_number()) throw InputError(fmt::format("'{}' must be a number", name));
  return value->get<double>();
}

Document options_member(const Document& message) {
  const auto value = message.find("options");
  if (value == message.end() || !value->is_object()) throw InputError("'options' must be an object");
  return *value;
}

/// What needs no answer need not have a `seq`.
LiveNumber number_of(const Document& message) {
  return {whole_member<std::uint16_t>(message, "id"),
          message.contains("seq") ? whole_member<std::uint32_t>(message, "seq") : 0};
}

std::string text_member(const Document& message, const char* name) {
  const auto value = message.find(name);
  return value != message.end() && value->is_string() ? value->get<std::string>() : std::string();
}

void send_answer(LiveConnection& to, const char* type, const LiveNumber& number, const Document& answer) {
  Document document = numbered(type, number);
  document.update(answer);
  to.send_text(json_text(document));
}

/// Does what a message of this type asks, and tells the client where that fails. Throws Cancelled.
void answering(LiveConnection& to, const std::string& type, const LiveNumber& number, const auto& answer) {
  try {
    answer();
  } catch (const std::exception&) {
    Document failure{{"of", type}};
    failure.update(failure_document(current_failure().message));
    send_answer(to, "error", number, failure);
  }
}

}  // namespace

LiveMap::LiveMap(ServedStore& served, std::string key, std::shared_ptr<LiveConnection> connection)
    : served_(served), probe_(served), key_(std::move(key)), connection_(std::move(connection)) {}

bool LiveMap::take(const std::string& text) {
  const Document message = Document::parse(text, nullptr, false);
  if (!message.is_object()) return false;
  if (!welcome_) return take_hello(message);
  const std::string type = text_member(message, "type");
  LiveNumber number;
  answering(*connection_, type, number, [&] {
    number = number_of(message);
    take(type, number, message);
  });
  return true;
}

bool LiveMap::take_hello(const Document& message) {
  welcome_ = text_member(message, "type") == "hello" && is_same_key(text_member(message, "key"), key_);
  if (welcome_) connection_->send_text(R"({"type":"welcome"})");
  return welcome_;
}

void LiveMap::take(const std::string& type, const LiveNumber& number, const Document& message) {
  if (type == "view") return view(number, message);
  if (type == "move") return move(number, message);
  if (type == "stop") return stop(number);
  if (type == "probe") return probe(number, message);
  if (type == "line") return line(number, message);
  throw InputError(fmt::format("there is no message '{}'; the types are view, move, stop, probe and line", type));
}

const Document& LiveMap::options_of(const LiveNumber& number) const {
  const auto found = views_.find(number.id);
  if (found == views_.end()) throw InputError(fmt::format("there is no view {}", number.id));
  return found->second;
}

void LiveMap::view(const LiveNumber& number, const Document& message) {
  Document options = options_member(message);
  if (!views_.contains(number.id) && views_.size() >= kMostViews)
    throw InputError(fmt::format("a connection has at most {} views; stop another one", kMostViews));
  views_.insert_or_assign(number.id, std::move(options));
  show(number);
}

void LiveMap::move(const LiveNumber& number, const Document& message) {
  Document options = options_of(number);
  options["observer"] = message.value("observer", Document(nullptr));
  views_[number.id] = std::move(options);
  show(number);
}

void LiveMap::show(const LiveNumber& number) {
  drawing_.put(number.id, [this, number, options = views_.at(number.id), to = connection_](LatestWork::Run& run) {
    answering(*to, "view", number, [&] { show_view(served_, number, options, *to, run); });
  });
}

void LiveMap::stop(const LiveNumber& number) {
  views_.erase(number.id);
  drawing_.drop(number.id);
}

void LiveMap::probe(const LiveNumber& number, const Document& message) {
  const Point2 position{number_member(message, "x"), number_member(message, "y")};
  asking_.put(kProbeKey, [this, number, position, options = options_of(number), to = connection_](LatestWork::Run&) {
    answering(*to, "probe", number, [&] {
      served_.require_unchanged();
      send_answer(*to, "probe", number, probe_.answer(options, position));
    });
  });
}

void LiveMap::line(const LiveNumber& number, const Document& message) {
  asking_.put(number.id, [this, number, options = options_member(message), to = connection_](LatestWork::Run&) {
    answering(*to, "line", number, [&] {
      served_.require_unchanged();
      send_answer(*to, "line", number, los_answer(served_, arguments_of(options)));
    });
  });
}

}  // namespace itin::cli
