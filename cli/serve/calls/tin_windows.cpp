#include "serve/calls/tin_windows.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include <itin/error.hpp>
#include <itin/unfinished.hpp>

#include "serve/calls/admission.hpp"
#include "serve/calls/child_process.hpp"
#include "serve/calls/job_call.hpp"

namespace itin::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "window.glb";
constexpr int kWrongCall = 2;
constexpr std::uint64_t kPartForChild = 8, kPartForBytes = 16;

/// The call of `itin tin` that the query asks for.
Document call_for(const HttpQuery& query) {
  Document options = Document::object();
  for (const auto& [name, value] : query) {
    if (name != "bbox" && name != "tolerance" && name != "themes")
      throw InputError(fmt::format("--{}: give bbox, tolerance and themes alone", name));
    options[name] = value;
  }
  if (!options.contains("bbox")) throw InputError("--bbox: give xmin,ymin,xmax,ymax");
  options["output"] = kFile;
  return {{"verb", "tin"}, {"options", options}};
}

}  // namespace

std::optional<std::string> TinWindows::glb(const HttpQuery& query, const Progress& progress) {
  const JobCall call = job_call(served_, uploads_, call_for(query), served_.memory_bytes() / kPartForChild, threads_);
  const std::unique_lock lock(one_, std::try_to_lock);
  if (!lock) return std::nullopt;
  return made(call.arguments, progress);
}

std::string TinWindows::made(const std::vector<std::string>& arguments, const Progress& progress) const {
  const Unfinished folder((folder_.path() / random_key()).string(), Unfinished::Kind::folder);
  const fs::path path(folder.path());
  std::error_code failed;
  if (!fs::create_directory(path, failed)) throw FileError(path.string(), "cannot be made: " + failed.message());
  ChildProcess process(arguments, path.string(), (path / "document.json").string());
  const auto [status, error] = end_of(process, progress);
  if (status == kWrongCall) throw InputError(error);
  if (status != 0) throw Error(error.empty() ? fmt::format("the call ended with status {}", status) : error);
  if (const auto bytes = fs::file_size(path / kFile, failed); !failed && bytes > most_bytes())
    throw InputError(
        fmt::format("--tolerance: the window has {} MB of triangles, more than {}; give a larger "
                    "tolerance or a smaller bbox",
                    bytes >> 20, most_bytes() >> 20));
  std::ifstream file(path / kFile, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::uint64_t TinWindows::most_bytes() const {
  return served_.memory_bytes() / kPartForBytes;
}

}  // namespace itin::cli
