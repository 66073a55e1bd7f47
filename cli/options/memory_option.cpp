#include "options/memory_option.hpp"

#include <algorithm>

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

namespace {

std::uint64_t part_of(std::optional<std::uint64_t> memory_bytes, std::uint64_t share, std::uint64_t most) {
  return memory_bytes ? std::min(most, *memory_bytes / share) : most;
}

}  // namespace

void MemoryOption::declare(CLI::App& app, const std::string& help) {
  begin_group(app, kRunning);
  app.add_option("--memory", text_, help)->type_name("SIZE");
}

std::optional<std::uint64_t> MemoryOption::bytes() const {
  return text_.empty() ? std::nullopt : std::optional(parse_bytes("--memory", text_));
}

StoreOptions cache_within(std::optional<std::uint64_t> memory_bytes) {
  return {part_of(memory_bytes, 4, StoreOptions().cache_bytes)};
}

SectionSurface::Options section_cache_within(std::optional<std::uint64_t> memory_bytes) {
  return {part_of(memory_bytes, 8, SectionSurface::Options().cache_bytes)};
}

}  // namespace itin::cli
