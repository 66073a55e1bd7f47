// Lines of sight and profiles for clients: the documents that the verbs print.
#pragma once

#include <string>
#include <vector>

#include <itin/document.hpp>
#include <itin/progress.hpp>

#include "serve/ground/served_store.hpp"

namespace itin::cli {

/// The document of `itin los`, with `warnings`, and the `profile` that PROTOCOL.md describes. Throws InputError for
/// arguments that are wrong or name files, and what profile::analyse() throws.
Document los_answer(const ServedStore& served, const std::vector<std::string>& arguments);

/// The document of `itin profile`, with `warnings`. Throws alike.
Document profile_answer(const ServedStore& served, const std::vector<std::string>& arguments, Progress& progress);

}  // namespace itin::cli
