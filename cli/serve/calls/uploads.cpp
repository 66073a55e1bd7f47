#include "serve/calls/uploads.hpp"

#include <algorithm>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/output_file.hpp>
#include <itin/unfinished.hpp>

#include "serve/calls/admission.hpp"
#include "serve/calls/child_process.hpp"
#include "serve/ground/given_options.hpp"

namespace itin::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostUploads = 16;
constexpr std::pair<std::string_view, const char*> kEndings[] = {
    {"text/csv", ".csv"}, {"application/geo+json", ".geojson"}, {"application/json", ".geojson"}};

void remove_file(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

}  // namespace

std::optional<std::string> upload_ending(std::string_view content_type) {
  const std::string_view type = content_type.substr(0, content_type.find_first_of("; "));
  for (const auto& [known, ending] : kEndings)
    if (type == known) return ending;
  return std::nullopt;
}

Document Uploads::add(const std::string& ending, std::string_view bytes) {
  const std::string name = fmt::format("upload-{}{}", random_key(), ending);
  Unfinished file(path(name).string());
  write_file(file.path(), bytes, false);
  Document document = read(name);
  file.finish([&] { keep(name); });
  return document;
}

std::optional<Document> Uploads::told(const std::string& name) const {
  if (!has(name)) return std::nullopt;
  return read(name);
}

Document Uploads::read(const std::string& name) const {
  const Unfinished answer(path(fmt::format("{}.{}", name, random_key())).string());
  std::vector<std::string> arguments = call_of(
      served_, {name, fmt::format("--memory={}", served_.memory_bytes() / 4), "--json", "--quiet", "--uploads"});
  arguments.insert(arguments.begin(), "read-upload");
  ChildProcess process(arguments, folder_.path().string(), answer.path());
  const auto [status, error] = end_of(process, NoProgress());
  if (status != 0)
    throw InputError(error.empty() ? name + ": takes too much memory or time to read; send a smaller file" : error);
  std::ifstream output(answer.path());
  const Document said = Document::parse(output, nullptr, false);
  if (!said.is_object()) throw FileError(answer.path(), "could not be written; is the disk full?");
  Document document{{"name", name}};
  document.update(said);
  for (const char* of_the_call : {"itin", "command", "statistics"}) document.erase(of_the_call);
  return document;
}

void Uploads::keep(const std::string& name) {
  const std::lock_guard lock(mutex_);
  names_.push_back(name);
  if (names_.size() <= kMostUploads) return;
  remove_file(path(names_.front()));
  names_.pop_front();
}

bool Uploads::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return false;
  remove_file(path(name));
  names_.erase(found);
  return true;
}

bool Uploads::has(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

}  // namespace itin::cli
