// The help as one document, for programs that call this one: all verbs, their groups and options, made from the options
// as they are declared.
#pragma once

#include <CLI/CLI.hpp>

#include <itin/document.hpp>

namespace itin::cli {

/// `itin` and `verbs` [{`name`, `summary`, `groups` [{`name`, `options` [...]}]}], in the order of --help. An option
/// has `names`, `help`, `kind` (`flag`, `value` or `argument`), `required` and `repeats`; unless it is a flag also
/// `type`, the form of its value, and where it has them `unit`, `choices`, `default`, and `files`, what becomes of the
/// files that it names (`reads`, `writes` or `replaces`).
Document help_document(const CLI::App& app);

}  // namespace itin::cli
