// Makes documents about the store behind a result, and numbers in the form people read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <itin/counted.hpp>
#include <itin/store.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// The `themes`, in the store's order, as a document and as text.
Document themes_document(const StoreMetadata& metadata);
std::string themes_table(const StoreMetadata& metadata);

/// The `levels`, finest first. A level's `vertices` are the ones stored in it, so that they sum up to the store's. Its
/// `query_vertices` are the ones that a query at its tolerance reads: its own and those of all coarser levels. Levels
/// after level 0 tell whether their triangles about the posts of rasters are right ones; older stores do not tell.
Document levels_document(const StoreMetadata& metadata);

/// The `levels` as an aligned table.
std::string levels_table(const StoreMetadata& metadata);

/// Writes 1234567 as "1.2 MB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace itin::cli
