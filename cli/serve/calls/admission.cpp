#include "serve/calls/admission.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include <itin/lower_case.hpp>

#include "serve/calls/uploads.hpp"

namespace itin::cli {

namespace {

constexpr std::uint16_t kHttpPort = 80;

bool has_port(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  return colon != std::string::npos && name.find(']', colon) == std::string::npos &&
         (name.front() == '[' || name.find(':') == colon);
}

bool is_listed(const std::vector<std::string>& list, const std::string& text) {
  return std::find(list.begin(), list.end(), in_lower_case(text)) != list.end();
}

bool is_json(const std::string& content_type) {
  const std::string type = in_lower_case(content_type.substr(0, content_type.find(';')));
  return type.substr(0, type.find_last_not_of(' ') + 1) == "application/json";
}

}  // namespace

std::string random_key() {
  std::array<unsigned char, 16> bytes{};
  if (getentropy(bytes.data(), bytes.size()) != 0)
    throw std::system_error(errno, std::generic_category(), "getentropy");
  std::string key;
  for (const unsigned char byte : bytes) key += fmt::format("{:02x}", byte);
  return key;
}

bool is_same_key(std::string_view given, std::string_view key) {
  unsigned different = given.size() == key.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(given.size(), key.size()); ++i)
    different |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(key[i]);
  return different == 0;
}

Admission::Admission(const std::vector<std::string>& names, std::uint16_t port, std::string key)
    : key_(std::move(key)) {
  std::vector<std::string> all = names;
  all.insert(all.end(), {"127.0.0.1", "localhost", "[::1]"});
  for (const std::string& name : all) {
    const std::string host = in_lower_case(name);
    if (has_port(host) || port == kHttpPort) hosts_.push_back(host);
    if (!has_port(host)) hosts_.push_back(fmt::format("{}:{}", host, port));
  }
  for (const std::string& host : hosts_) origins_.push_back("http://" + host), origins_.push_back("https://" + host);
}

std::string Admission::url() const {
  return fmt::format("http://{}/#key={}", hosts_.front(), key_);
}

std::optional<HttpResponse> Admission::refusal(const HttpRequest& request) const {
  if (!is_listed(hosts_, request.host))
    return http_failure(403, "this name of the server is not allowed; start it with --allow-host NAME");
  if (!request.origin.empty() && !is_listed(origins_, request.origin))
    return http_failure(403, "pages of another origin may not ask");
  if (request.method == "GET") return std::nullopt;
  if (request.method != "POST" && request.method != "DELETE")
    return http_failure(405, "the methods are GET, POST and DELETE");
  if (!is_same_key(request.key, key_))
    return http_failure(403, "give the key of the printed URL as the header X-Itin-Key");
  if (request.method == "POST" && request.path != kUploadsPath && !is_json(request.content_type))
    return http_failure(415, "send application/json");
  if (request.method == "POST" && request.path == kUploadsPath && !upload_ending(request.content_type))
    return http_failure(415, "send text/csv or application/geo+json");
  return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> protective_headers() {
  return {{"Content-Security-Policy",
           "default-src 'self'; img-src 'self' data: blob:; worker-src 'self' blob:; "
           "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
          {"X-Content-Type-Options", "nosniff"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Referrer-Policy", "no-referrer"}};
}

}  // namespace itin::cli
