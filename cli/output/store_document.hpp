// Documents about the store behind a result, and numbers in the form people read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <itin/detail.hpp>
#include <itin/store.hpp>

#include "program/verb.hpp"

namespace itin::cli {

/// [lo, hi] of a certificate.
Document error_interval(const CertifiedError& error);

/// `surface`: tolerance, certified error and themes of the surface that a query at this detail sees. With rings the
/// tolerance is the coarsest, the error covers all, and the rings are listed.
Document surface_document(const StoreMetadata& metadata, const Detail& detail, const ThemeChoice& themes);

/// `themes`, in the store's order, as a document and as text.
/// Those that something was made of.
Document used_sources_document(const std::vector<SourceInfo>& sources);
Document themes_document(const StoreMetadata& metadata);
std::string themes_table(const StoreMetadata& metadata);

/// `levels`, finest first. A level's `vertices` are those stored in it, so that they sum up to the store's;
/// `query_vertices` are those that a query at its tolerance reads: its own and all coarser ones.
Document levels_document(const StoreMetadata& metadata);

/// `levels` as an aligned table.
std::string levels_table(const StoreMetadata& metadata);

/// [xmin, ymin, xmax, ymax] with names.
Document box_document(const Box& box);

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// "1 block", "1,234 blocks"; `plural` where it is not made by an s.
std::string counted(std::uint64_t number, std::string_view noun, std::string_view plural = {});

/// 1234567 as "1.2 MB".
std::string readable_bytes(std::uint64_t bytes);

}  // namespace itin::cli
