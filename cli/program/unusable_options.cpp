#include "program/unusable_options.hpp"

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::cli {

void require_not_given(const CLI::App& app, std::initializer_list<const char*> options, std::string_view why) {
  for (const char* option : options)
    if (app.get_option(option)->count() > 0) throw InputError(fmt::format("{} {}", option, why));
}

}  // namespace itin::cli
