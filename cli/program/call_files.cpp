#include "program/call_files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <sys/stat.h>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/source_files.hpp>

namespace itin::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kReads = "reads";
constexpr const char* kWrites = "writes";
constexpr const char* kReplaces = "replaces";

/// Marks an option with a role. CLI11 keeps no notes of its callers except the names of validators; this one lets
/// everything pass.
CLI::Option* marked(CLI::Option* option, const char* role) {
  return option->check(CLI::Validator().name(role));
}

bool has_role(CLI::Option* option, const char* role) {
  return role_of(*option) == role;
}

bool names_files(const CLI::Option& option) {
  constexpr const char* kTypes[] = {"FILE", "DIR", "AREA"};
  if (option.get_positional()) return true;
  const std::string type = option.get_type_name();
  return std::any_of(std::begin(kTypes), std::end(kTypes),
                     [&](const char* name) { return type.find(name) != std::string::npos; });
}

/// The place of a path with all links followed.
std::string place_of(const std::string& path) {
  std::error_code unknown;
  const fs::path place = fs::weakly_canonical(fs::absolute(path, unknown), unknown);
  return unknown ? path : place.string();
}

/// An identity that all names of one file share, whether the file exists or is to come.
std::string identity(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) == 0) return fmt::format("{}:{}", status.st_dev, status.st_ino);
  return place_of(path);
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool lies_within(const fs::path& file, const fs::path& folder) {
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end();
}

/// The files that are read where one is named: the file itself and, for a virtual one, the files behind it.
std::vector<std::string> read_for(const std::string& path) {
  std::vector<std::string> files{path};
  if (!path.ends_with(".vrt")) return files;
  const std::vector<std::string> behind = source_files(path);
  files.insert(files.end(), behind.begin(), behind.end());
  return files;
}

/// A sidecar, which goes with its raster where the raster is replaced.
std::string sidecar(const std::string& path) {
  return path + ".aux.xml";
}

void require_no_dangling_link(const std::string& option, const std::string& path) {
  std::error_code ignored;
  if (!fs::is_symlink(path, ignored) || is_there(path)) return;
  throw InputError(fmt::format("{} '{}': is a symbolic link to {}, which is not there; name that, or remove the link",
                               option, path, fs::read_symlink(path, ignored).string()));
}

}  // namespace

CLI::Option* reads(CLI::Option* option) {
  return marked(option, kReads);
}
CLI::Option* writes(CLI::Option* option) {
  return marked(option, kWrites);
}
CLI::Option* replaces(CLI::Option* option) {
  return marked(option, kReplaces);
}

std::string role_of(const CLI::Option& option) {
  // What an option has been checked by can be asked of options that may change alone.
  auto& asked = const_cast<CLI::Option&>(option);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  for (const char* role : {kReads, kWrites, kReplaces}) {
    try {
      asked.get_validator(role);
      return role;
    } catch (const CLI::OptionNotFound&) {
      continue;
    }
  }
  return {};
}

void require_roles(CLI::App& verb) {
  for (CLI::Option* option : verb.get_options([](const CLI::Option* o) { return names_files(*o); })) {
    if (role_of(*option).empty())
      throw std::logic_error(
          fmt::format("{} {} names files, but not whether they are read", verb.get_name(), option->get_name()));
  }
}

CallFiles::CallFiles(CLI::App& verb) {
  const std::vector<CLI::Option*> options = verb.get_options([](const CLI::Option* o) { return o->count() > 0; });
  for (CLI::Option* option : options) {
    if (!has_role(option, kReads)) continue;
    for (const std::string& given : option->results())
      for (const std::string& path : read_for(given))
        if (is_there(path)) inputs_.emplace(identity(path), Named{option->get_name(), path});
  }
  for (CLI::Option* option : options) {
    const bool folder = has_role(option, kReplaces);
    if (!folder && !has_role(option, kWrites)) continue;
    for (const std::string& path : option->results()) {
      const Named output{option->get_name(), path};
      require_no_dangling_link(output.option, path);
      add(output);
      if (folder) require_none_within(output);
    }
  }
}

void CallFiles::add_output(const std::string& path) {
  add({"the output", path});
}

std::string CallFiles::Named::text() const {
  return fmt::format("{} '{}'", option, path);
}

void CallFiles::add(const Named& output) {
  for (const std::string& name : {output.path, sidecar(output.path)}) {
    const auto input = inputs_.find(identity(name));
    if (input != inputs_.end())
      throw InputError(fmt::format("{}: would be written over {}, the same file; give the output another name",
                                   output.text(), input->second.text()));
  }
  const auto [other, first] = outputs_.emplace(identity(output.path), output);
  if (!first)
    throw InputError(
        fmt::format("{} and {} are one file; give each output a name of its own", other->second.text(), output.text()));
}

void CallFiles::require_none_within(const Named& folder) const {
  const std::string place = place_of(folder.path);
  for (const auto& [ignored, input] : inputs_) {
    const fs::path name =
        fs::path(place_of(fs::path(input.path).parent_path() / ".")) / fs::path(input.path).filename();
    if (lies_within(place_of(input.path), place) || lies_within(name, place))
      throw InputError(fmt::format("{}: would be replaced with {} in it; write to another folder, or move that file",
                                   folder.text(), input.text()));
  }
}

}  // namespace itin::cli
