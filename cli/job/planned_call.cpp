#include "job/planned_call.hpp"

#include <algorithm>
#include <filesystem>
#include <sys/stat.h>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/file_digest.hpp>
#include <itin/source_files.hpp>
#include <itin/store.hpp>

namespace itin::cli {

namespace {

namespace fs = std::filesystem;
using viewshed::JobEnd;
using viewshed::JobError;
using viewshed::JobFolder;
using viewshed::StorePrint;

/// Larger files are not copied: every runner has to see them under the name that the call has for them.
constexpr std::uintmax_t kMostCopied = std::uintmax_t{64} << 20;

bool is_file(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

/// The files to copy for one that an option names: with its sidecars; none where it names files elsewhere, or they are
/// large.
std::vector<std::string> files_to_copy(const std::string& path) {
  std::vector<std::string> files = source_files(path);
  if (std::find(files.begin(), files.end(), path) == files.end()) files.push_back(path);
  std::uintmax_t bytes = 0;
  for (const std::string& file : files) {
    if (fs::path(file).parent_path() != fs::path(path).parent_path()) return {};
    std::error_code ignored;
    bytes += fs::file_size(file, ignored);
  }
  return bytes <= kMostCopied ? files : std::vector<std::string>{};
}

bool has_digest(const std::string& path, const std::string& digest, Progress& progress) {
  return is_file(path) && file_sha256(path, progress) == digest;
}

/// Replaces a value among arguments, also behind the equals sign of an option. Returns whether it is there.
bool replace_value(std::vector<std::string>& arguments, const std::string& value, const std::string& by) {
  bool is_there = false;
  for (std::string& argument : arguments) {
    const bool behind = argument.starts_with("-") && argument.ends_with("=" + value);
    if (argument != value && !behind) continue;
    argument.replace(argument.size() - value.size(), value.size(), by);
    is_there = true;
  }
  return is_there;
}

StorePrint print_in(const Document& store) {
  return {store.value("bytes", std::uint64_t{0}), store.value("id", std::uint64_t{0})};
}

/// What changes whenever a file is written, or exchanged for another one.
FileStamp stamp_of(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Returns the arguments of the call, with the names that the files have here.
std::vector<std::string> arguments_here(const JobFolder& job, const std::string& store, Progress& progress) {
  const Document& document = job.document();
  if (const auto version = document.value("itin", ""); version != ITIN_VERSION)
    throw JobError(JobEnd::kRefused,
                   fmt::format("{}: was planned by itin {}, and this is itin {}; run the same version", job.path(),
                               version, ITIN_VERSION));
  auto arguments = document["arguments"].get<std::vector<std::string>>();
  replace_value(arguments, document["store"].value("name", ""), store);
  for (const Document& input : document["inputs"]) {
    const std::string name = input.value("name", ""), digest = input.value("sha256", "");
    const std::string copy = input.value("copy", "");
    if (has_digest(name, digest, progress)) continue;
    // A file that another one names, as parameters do, has no place among the arguments.
    if (copy.empty() || !has_digest(job.input(copy), digest, progress) ||
        !replace_value(arguments, name, job.input(copy)))
      throw FileError(name, "is not the file that the job was planned with; bring that back, or plan the job anew");
  }
  return arguments;
}

}  // namespace

std::string store_of_job(const JobFolder& job, const std::string& given, Progress& progress) {
  const Document& store = job.document()["store"];
  std::vector<std::string> paths{store.value("name", ""), store.value("path", "")};
  if (!given.empty()) paths = {given};
  std::string other;
  for (const std::string& path : paths) {
    if (!is_file(path)) continue;
    const Store opened(path);
    if (viewshed::print_of(opened) == print_in(store)) return path;
    // A store that was imported elsewhere may have the same content.
    if (content_digest(opened, progress) == store.value("digest", "")) return path;
    if (other.empty()) other = path;
  }
  if (!other.empty())
    throw JobError(JobEnd::kStoreChanged,
                   fmt::format("{}: is not the store that {} was planned for; plan the job anew, or name the store by "
                               "--store",
                               other, job.path()));
  throw FileError(paths.back(), "is not there; name the job's store by --store");
}

JobPlan plan_of(const VerbCall& call, std::uint64_t most_cells, Progress& progress) {
  const std::string store = call.store();
  if (!is_file(store)) throw FileError(store, "is no store; itin import makes one");
  const Store opened(store);
  const StorePrint print = viewshed::print_of(opened);
  JobPlan plan;
  plan.document = {{"itin", ITIN_VERSION},
                   {"arguments", call.arguments()},
                   {"most_cells", most_cells},
                   {"store",
                    {{"name", store},
                     {"path", fs::absolute(store).lexically_normal().string()},
                     {"bytes", print.bytes},
                     {"id", print.id},
                     {"digest", content_digest(opened, progress)}}},
                   {"inputs", Document::array()}};
  std::vector<std::string> seen;
  for (const std::string& path : call.inputs()) {
    if (!is_file(path) || std::find(seen.begin(), seen.end(), path) != seen.end()) continue;
    seen.push_back(path);
    const std::string folder = std::to_string(seen.size());
    std::string copy;
    for (const std::string& file : files_to_copy(path)) {
      const std::string name = folder + "/" + fs::path(file).filename().string();
      plan.inputs.emplace_back(file, name);
      if (file == path) copy = name;
    }
    plan.document["inputs"].push_back({{"name", path}, {"copy", copy}, {"sha256", file_sha256(path, progress)}});
  }
  return plan;
}

PlannedCall::PlannedCall(const JobFolder& job, const std::string& store, Progress& progress)
    : store_(store_of_job(job, store, progress)),
      stamp_(stamp_of(store_)),
      most_cells_(job.document().value("most_cells", std::uint64_t{0})),
      dividing_(arguments_here(job, store_, progress)),
      executing_(dividing_.arguments()) {}

std::unique_ptr<viewshed::Tasks> PlannedCall::divide(Progress& progress) {
  return dividing_.complete().divide(most_cells_, progress);
}

void PlannedCall::require_same_store() const {
  if (stamp_of(store_) == stamp_) return;
  throw JobError(JobEnd::kStoreChanged, fmt::format("{}: was changed since this run began; plan the job anew", store_));
}

Verb& PlannedCall::verb() {
  return executing_.complete();
}

}  // namespace itin::cli
