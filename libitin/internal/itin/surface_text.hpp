// What a query sees for a surface, in words.
//
//   facts.emplace_back("Surface", surface_text(store.metadata(), detail));
#pragma once

#include <string>

#include <itin/detail.hpp>
#include <itin/store.hpp>
#include <itin/theme.hpp>

namespace itin {

/// Returns "every stored point"; or "tolerance 4 m, certified error -3.98 to +3.96 m"; with rings "tolerance 0 m within
/// 50 m, 4 m within 150 m, certified error ...".
std::string surface_text(const StoreMetadata& metadata, const Detail& detail);

/// Returns "without woods, Big Wood (id 3); houses, feature 7"; empty where no feature is left out.
std::string omitted_text(const ThemeChoice& themes);

}  // namespace itin
