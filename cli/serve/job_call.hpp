// A call of this program that a client asks for, checked before it is made.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>

#include "serve/served_store.hpp"

namespace itin::cli {

struct JobCall {
  std::string verb;
  std::vector<std::string> arguments;  ///< from the verb on, for a program that runs in the folder of its outputs
  std::string command;                 ///< what a person would type
};

/// The verbs that clients may call: those that read nothing but the store.
std::vector<std::string> job_verbs();

/// Understands {"verb", "options"}. `memory_bytes` and `threads` are for the call. Throws InputError for a
/// verb or an option that clients may not use, and for what the verb itself refuses before it opens the store.
JobCall job_call(const ServedStore& served, const Document& asked, std::uint64_t memory_bytes, int threads);

}  // namespace itin::cli
