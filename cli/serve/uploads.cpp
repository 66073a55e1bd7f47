#include "serve/uploads.hpp"

#include <algorithm>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/output_file.hpp>

#include "serve/child_process.hpp"
#include "serve/given_options.hpp"

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

/// Removes a file at the end of its life, unless it is kept.
class Passing {
 public:
  explicit Passing(fs::path path) : path_(std::move(path)) {}
  ~Passing() {
    if (!kept_) remove_file(path_);
  }
  Passing(const Passing&) = delete;
  Passing& operator=(const Passing&) = delete;
  void keep() { kept_ = true; }

 private:
  fs::path path_;
  bool kept_ = false;
};

}  // namespace

std::optional<std::string> upload_ending(std::string_view content_type) {
  const std::string_view type = content_type.substr(0, content_type.find_first_of("; "));
  for (const auto& [known, ending] : kEndings)
    if (type == known) return ending;
  return std::nullopt;
}

Document Uploads::add(const std::string& ending, std::string_view bytes) {
  std::string name;
  {
    const std::lock_guard lock(mutex_);
    name = fmt::format("upload-{}{}", ++count_, ending);
  }
  Passing file(path(name));
  write_file(path(name).string(), bytes, false);
  Document document{{"name", name}, {"bytes", bytes.size()}};
  document.update(read(name));
  keep(name);
  file.keep();
  return document;
}

/// What the child that reads a file says of it.
Document Uploads::read(const std::string& name) const {
  const fs::path answer = path(name + ".read");
  const Passing passing(answer);
  ChildProcess process({"read-upload", fs::absolute(served_.store().path()).string(), name,
                        fmt::format("--memory={}", served_.memory_bytes() / 4), "--json", "--quiet", "--uploads"},
                       folder_.path().string(), answer.string());
  std::string error;
  for (std::string line; process.read_line(line);) error = told_error(line).value_or(error);
  const int status = process.wait();
  if (status != 0)
    throw InputError(error.empty() ? name + ": takes too much memory or time to read; send a smaller file" : error);
  std::ifstream output(answer);
  Document document = Document::parse(output, nullptr, false);
  if (!document.is_object()) throw FileError(answer.string(), "could not be written; is the disk full?");
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
