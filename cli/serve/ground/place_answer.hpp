// What a single place is, for clients: its coordinates in several systems, and the ground there.
#pragma once

#include <string>

#include <itin/document.hpp>
#include <itin/progress.hpp>

#include "serve/ground/served_store.hpp"
#include "serve/http/http_message.hpp"

namespace itin::cli {

/// The document that PROTOCOL.md describes under `place`. The query has `at`, a place as the command line takes it.
/// Throws InputError for a place that cannot be understood or lies off the data, and what heights_at() throws.
Document place_answer(const ServedStore& served, const HttpQuery& query, Progress& progress);

}  // namespace itin::cli
