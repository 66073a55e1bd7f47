// A call of this program that a client asks for, checked before it is made.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <itin/document.hpp>

#include "serve/calls/uploads.hpp"
#include "serve/ground/served_store.hpp"

namespace itin::cli {

struct JobCall {
  std::string verb;
  Document options;                       ///< as they were asked for
  std::vector<std::string> arguments;     ///< from the verb on, for a program that runs in the folder of its outputs
  std::string command;                    ///< what a person would type
  std::vector<std::string> uploads = {};  ///< names of uploads that it reads, in the folder of its outputs
};

/// The verbs that clients may call: those that read nothing but the store, and uploads.
std::vector<std::string> job_verbs();

/// Understands {"verb", "options"}. `memory_bytes` and `threads` are for the call. Throws InputError for a
/// verb or an option that clients may not use, and for what the verb itself refuses before it opens the store.
JobCall job_call(const ServedStore& served, const Uploads& uploads, const Document& asked, std::uint64_t memory_bytes,
                 int threads);

}  // namespace itin::cli
