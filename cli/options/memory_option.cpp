#include "options/memory_option.hpp"

#include "program/help.hpp"
#include "program/values.hpp"

namespace itin::cli {

void MemoryOption::declare(CLI::App& app, const std::string& help) {
  begin_group(app, kRunning);
  app.add_option("--memory", text_, help)->type_name("SIZE");
}

std::optional<std::uint64_t> MemoryOption::bytes() const {
  return text_.empty() ? std::nullopt : std::optional(parse_bytes("--memory", text_));
}

}  // namespace itin::cli
