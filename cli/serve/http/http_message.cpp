#include "serve/http/http_message.hpp"

#include <charconv>

#include <itin/document.hpp>

#include "serve/http/failure.hpp"

namespace itin::cli {

namespace {

/// Puts characters for percent signs, and spaces for plus signs.
std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i] == '+' ? ' ' : text[i];
      continue;
    }
    unsigned char byte = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    if (digits.size() < 2 || end != digits.data() + 2 || error != std::errc() || byte == 0) return std::nullopt;
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

std::optional<HttpQuery> decoded_query(std::string_view text) {
  HttpQuery query;
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    if (pair.empty()) continue;
    const std::size_t equals = pair.find('=');
    const auto name = percent_decoded(pair.substr(0, equals));
    const auto value = percent_decoded(equals == std::string_view::npos ? "" : pair.substr(equals + 1));
    if (!name || !value) return std::nullopt;
    query.emplace_back(*name, *value);
  }
  return query;
}

}  // namespace

std::optional<HttpTarget> http_target(std::string_view target) {
  const std::size_t mark = target.find('?');
  const auto path = percent_decoded(target.substr(0, mark));
  const auto query = decoded_query(mark == std::string_view::npos ? "" : target.substr(mark + 1));
  if (!path || !query) return std::nullopt;
  return HttpTarget{*path, *query};
}

HttpResponse http_failure(int status, const std::string& message) {
  return {status, "application/json", json_text(failure_document(message)) + "\n"};
}

}  // namespace itin::cli
