// How exact a query's surface is, in words.
//
//   facts.emplace_back("Surface", surface_text(store.metadata(), detail));
#pragma once

#include <string>

#include <itin/detail.hpp>
#include <itin/store.hpp>

namespace itin {

/// Returns "every stored point"; or "tolerance 4 m, certified error -3.98 to +3.96 m"; with rings "tolerance 0 m within
/// 50 m, 4 m within 150 m, certified error ...".
std::string surface_text(const StoreMetadata& metadata, const Detail& detail);

}  // namespace itin
