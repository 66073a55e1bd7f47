// Requests and answers of HTTP, without the network.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace itin::cli {

/// The longest header, body or message that is read, bytes; and the longest body of an upload.
inline constexpr std::size_t kMostHttpBytes = 16384, kMostUploadBytes = std::size_t{16} << 20;

/// Names and values, decoded, in the order of the query.
using HttpQuery = std::vector<std::pair<std::string, std::string>>;

struct HttpRequest {
  std::string method;
  std::string path;  ///< decoded, without the query
  HttpQuery query;
  std::string host, origin, key, content_type;  ///< headers; empty where they are not given
  std::string body;
};

struct HttpResponse {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// What comes before and behind the question mark of a target.
struct HttpTarget {
  std::string path;
  HttpQuery query;
};

/// Decodes a target, "/api/v1/los?from=1%2C2". Nothing where its percent signs stand for no characters, or for zeros.
std::optional<HttpTarget> http_target(std::string_view target);

/// The answer to what cannot be answered: {"error": message, "field": the option that the message begins with}.
HttpResponse http_failure(int status, const std::string& message);

}  // namespace itin::cli
