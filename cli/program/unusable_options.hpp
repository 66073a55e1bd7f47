// Options that a call cannot make use of.
#pragma once

#include <initializer_list>
#include <string_view>

#include <CLI/CLI.hpp>

namespace itin::cli {

/// Throws InputError where one of `options` is given. It names the option, and says `why` that is of no use ("works
/// only with a STORE").
void require_not_given(const CLI::App& app, std::initializer_list<const char*> options, std::string_view why);

}  // namespace itin::cli
