// Documents about the store behind a result, and numbers in the form people read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <itin/counted.hpp>
#include <itin/store.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// `themes`, in the store's order, as a document and as text.
Document themes_document(const StoreMetadata& metadata);
std::string themes_table(const StoreMetadata& metadata);

/// `levels`, finest first. A level's `vertices` are those stored in it, so that they sum up to the store's;
/// `query_vertices` are those that a query at its tolerance reads: its own and all coarser ones.
Document levels_document(const StoreMetadata& metadata);

/// `levels` as an aligned table.
std::string levels_table(const StoreMetadata& metadata);

/// 1234567 as "1.2 MB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace itin::cli
