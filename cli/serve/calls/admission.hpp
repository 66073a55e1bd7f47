// Who may ask the server what: by the names that a browser calls it, the page that asks, and the key of this run.
//
// A page of another site can make a browser send requests here, but cannot name another Host than the one that it
// calls, cannot hide its Origin, does not know the key, and cannot read answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "serve/http/http_message.hpp"

namespace itin::cli {

/// A random text that nobody can guess.
std::string random_key();
/// Compares in a time that does not tell where the texts differ.
bool is_same_key(std::string_view given, std::string_view key);

class Admission {
 public:
  /// `names`, at least one, are allowed besides those of the loopback, with or without a port of their own.
  Admission(const std::vector<std::string>& names, std::uint16_t port, std::string key);

  const std::string& key() const { return key_; }
  /// The address of the page, by the first of the names, with the key.
  std::string url() const;
  /// The answer to a request that is not allowed: another Host, the Origin of another page, or a change without the key
  /// or with a body that is no JSON, or for uploads no file of theirs: types that browsers send for no other page.
  std::optional<HttpResponse> refusal(const HttpRequest& request) const;

 private:
  std::vector<std::string> hosts_, origins_;
  std::string key_;
};

/// The headers of every answer.
std::vector<std::pair<std::string, std::string>> protective_headers();

}  // namespace itin::cli
