#include "import/removed_sources.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/error.hpp>
#include <itin/sort_unique.hpp>

namespace itin {

namespace {

/// Whether the source has brought features that stand.
bool stands(const SourceInfo& source, const StoreMetadata& metadata) {
  return std::any_of(metadata.themes.begin(), metadata.themes.end(),
                     [&](const ThemeInfo& theme) { return theme.is_raised() && theme.name == source.theme; });
}

[[noreturn]] void refuse(const std::string& name, const Store& store) {
  std::vector<std::string> names;
  for (const SourceInfo& source : store.metadata().sources)
    if (stands(source, store.metadata())) names.insert(names.end(), {source.theme, source.path});
  sort_unique(names);
  throw InputError(
      fmt::format("`remove` {}: {} has no theme of features that stand, nor a source of such, of this name; {}", name,
                  store.path(),
                  names.empty() ? "it has none at all" : fmt::format("it has {}", fmt::join(names, ", "))),
      "remove");
}

}  // namespace

Sources removed_sources(const std::vector<std::string>& names, const Store* store) {
  Sources removed;
  for (const std::string& name : names) {
    if (store == nullptr) throw InputError(fmt::format("`remove` {}: there is no such store yet", name), "remove");
    const std::vector<SourceInfo>& sources = store->metadata().sources;
    bool found = false;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      if (!stands(sources[s], store->metadata()) || (sources[s].theme != name && sources[s].path != name)) continue;
      removed.insert(static_cast<std::uint16_t>(s));
      found = true;
    }
    if (!found) refuse(name, *store);
  }
  return removed;
}

}  // namespace itin
