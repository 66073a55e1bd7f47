#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <itin/byte_archive.hpp>
#include <itin/output_file.hpp>
#include <itin/packed_file.hpp>
#include <itin/unfinished.hpp>
#include <viewshed/job.hpp>

#include "job/runner_name.hpp"

namespace itin::viewshed {

namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;
constexpr const char* kFolders[] = {"inputs", "tmp", "done", "stats", "claims", "failed"};
/// The mark of an answer's file, which also tells the order of bytes.
constexpr std::uint64_t kAnswer = 0x31'72'65'77'73'6e'61;
constexpr std::size_t kMostFailures = 3;
/// A runner that vanishes is mostly not the task's fault.
constexpr std::size_t kMostVanished = 10;

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw FileError(path, "cannot be read; is this the folder of a job? itin job plan makes one");
  return text;
}

Document parsed(const std::string& path, const std::string& text) {
  try {
    return Document::parse(text);
  } catch (const Document::exception&) {
    throw FileError(path, "is damaged: it is no JSON");
  }
}

std::string hexadecimal(std::uint64_t number) {
  return fmt::format("{:016x}", number);
}

std::string name_of(const std::string& job, std::size_t task) {
  return hexadecimal(content_hash(fmt::format("{} {}", job, task)));
}

/// All that a task is, in words that are equal for equal tasks.
std::string words_of(const Task& t) {
  return fmt::format("{},{} {}x{} {}", t.north_west.column, t.north_west.row, t.columns, t.rows, t.eyes);
}

std::string words_of(const std::vector<Task>& tasks) {
  std::string text;
  for (const Task& task : tasks) text += words_of(task) + "\n";
  return text;
}

Document line_of(const std::string& job, std::size_t number, const Task& task) {
  return {{"n", number},
          {"id", name_of(job, number)},
          {"column", task.north_west.column},
          {"row", task.north_west.row},
          {"columns", task.columns},
          {"rows", task.rows},
          {"eyes", task.eyes},
          {"points", task.points},
          {"cost_s", task.seconds}};
}

std::vector<std::size_t> dearest_first(const std::vector<Task>& tasks) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tasks[a].seconds > tasks[b].seconds; });
  return order;
}

bool is_there(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The names of a folder's files, but for those that somebody writes or has left unfinished: they begin with a dot.
std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::string name = at->path().filename().string(); name.front() != '.') names.push_back(std::move(name));
  if (error) throw FileError(folder, "cannot be read: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

void create_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directory(path, error);
  if (error) throw FileError(path.string(), "cannot be created: " + error.message());
}

void copy_file(const std::string& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::copy_file(from, to, error);
  if (error) throw FileError(from, "cannot be copied to " + to.string() + ": " + error.message());
}

/// When a file was last touched, seconds; nothing where it is gone.
std::optional<double> touched_at(const std::string& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

/// The time on the file server's clock.
double time_of_server(const std::string& job) {
  static std::atomic<unsigned> asked = 0;
  // A runner that takes this one for gone may remove the file before it is looked at.
  while (true) {
    const std::string path = fmt::format("{}/tmp/clock.{}.{}", job, ++asked, runner_name());
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0 || ::write(file, "\n", 1) != 1) {
      const std::string why = std::strerror(errno);
      if (file >= 0) ::close(file);
      throw JobError(JobEnd::kTryAgain, fmt::format("{}: cannot be written: {}", path, why));
    }
    ::close(file);
    const std::optional<double> now = touched_at(path);
    ::unlink(path.c_str());
    if (now) return *now;
  }
}

}  // namespace

void JobFolder::create(const std::string& path, Document document, const Tasks& tasks,
                       const std::vector<std::pair<std::string, std::string>>& inputs) {
  std::error_code ignored;
  if (is_there(path) && !(fs::is_directory(path, ignored) && fs::is_empty(path, ignored)))
    throw FileError(path, "is there already; name another folder, or go on with itin job run");
  const fs::path parent = fs::absolute(path).parent_path();
  if (!fs::is_directory(parent, ignored))
    throw FileError(path, "its parent folder does not exist; create it or name another place");
  const std::string plan = words_of(tasks.list());
  document["format"] = kFormat;
  document["tasks"] = tasks.list().size();
  document["plan"] = hexadecimal(content_hash(plan));
  const std::string job = hexadecimal(content_hash(json_text(document) + plan));
  document["job"] = job;
  Unfinished folder(fmt::format("{}.{}.tmp", path, ::getpid()), Unfinished::Kind::folder);
  const fs::path made = folder.path();
  create_folder(made);
  for (const char* name : kFolders) create_folder(made / name);
  for (int i = 0; i < 256; ++i) create_folder(made / "done" / fmt::format("{:02x}", i));
  for (const auto& [from, name] : inputs) copy_file(from, made / "inputs" / name);
  std::string lines;
  for (const std::size_t number : dearest_first(tasks.list()))
    lines += json_text(line_of(job, number, tasks.list()[number])) + "\n";
  write_file((made / "tasks.jsonl").string(), lines, false);
  write_file((made / "job.json").string(), json_text(document, 2) + "\n", false);
  folder.finish([&] {
    if (std::rename(made.c_str(), path.c_str()) != 0)
      throw FileError(path, std::string("cannot be written: ") + std::strerror(errno));
  });
}

JobFolder::JobFolder(std::string path) : path_(std::move(path)) {
  while (path_.size() > 1 && path_.back() == '/') path_.pop_back();
  const std::string head = path_ + "/job.json", list = path_ + "/tasks.jsonl";
  document_ = parsed(head, read_text(head));
  if (document_.value("format", 0) != kFormat) throw FileError(head, "is of another format than this itin writes");
  names_.resize(document_.value("tasks", std::size_t{0})), seconds_.resize(names_.size());
  std::istringstream lines(read_text(list));
  for (std::string line; std::getline(lines, line);) {
    const Document task = parsed(list, line);
    const auto number = task.value("n", names_.size());
    if (number >= names_.size()) throw FileError(list, "is damaged: it has a task that job.json does not count");
    names_[number] = task.value("id", ""), seconds_[number] = task.value("cost_s", 0.0);
    order_.push_back(number);
  }
  if (order_.size() != names_.size()) throw FileError(list, "is damaged: it has not all tasks that job.json counts");
}

void JobFolder::require_same(const Tasks& tasks) const {
  if (tasks.list().size() != count() ||
      document_.value("plan", "") != hexadecimal(content_hash(words_of(tasks.list()))))
    throw JobError(JobEnd::kRefused, path_ +
                                         ": this program divides the question into other tasks than those of the job; "
                                         "run the program that planned it, or plan it anew");
}

std::string JobFolder::name_path(const char* folder, std::size_t task) const {
  return fmt::format("{}/{}/{}", path_, folder, names_.at(task));
}

std::optional<std::size_t> JobFolder::task_of(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name.substr(0, name.find('.')));
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

namespace {

std::string done_path(const std::string& job, const std::string& name) {
  return fmt::format("{}/done/{}/{}", job, name.substr(0, 2), name);
}

}  // namespace

bool JobFolder::is_done(std::size_t task) const {
  return is_there(done_path(path_, names_.at(task)));
}

std::string JobFolder::answer(std::size_t task) const {
  const std::string path = done_path(path_, names_.at(task)), file = read_packed(path);
  std::uint64_t kind = 0;
  std::string name, answer;
  try {
    ValueReader reader(file);
    reader(kind, name, answer);
    reader.expect_end();
  } catch (const NotThoseValues&) {
    kind = 0;
  }
  if (kind != kAnswer || name != names_[task]) throw FileError(path, "is not the answer of this task");
  return answer;
}

void JobFolder::seal(std::size_t task, const std::string& answer, const std::function<void()>& guard) const {
  const std::string written = name_path("tmp", task) + "." + runner_name();
  ValueWriter writer;
  writer(kAnswer, names_.at(task), answer);
  Placed placed = Placed::kPlaced;
  try {
    const Unfinished file(written);
    write_packed(written, writer.bytes());
    guard();
    placed = place_for_good(written, done_path(path_, names_[task]));
    if (placed == Placed::kDiffering)
      std::rename(written.c_str(), fmt::format("{}.other", name_path("failed", task)).c_str());
  } catch (const FileError& error) {
    throw JobError(JobEnd::kTryAgain, error.what());
  }
  if (placed != Placed::kDiffering) return;
  throw JobError(JobEnd::kTwoAnswers,
                 fmt::format("task {} has two answers with different bytes, {} and {}.other: a defect of a machine, or "
                             "of itin; keep both, and report it",
                             task, done_path(path_, names_[task]), name_path("failed", task)));
}

namespace {

std::string refusal(const std::string& failed) {
  return failed + ".refused";
}
std::string failure(const std::string& failed, std::size_t k) {
  return fmt::format("{}.{}", failed, k);
}
std::string vanished(const std::string& failed, std::size_t k) {
  return fmt::format("{}.vanished.{}", failed, k);
}

/// Writes the first of the files name(1), ..., name(most) that is not there.
template <class Name>
void write_next(const Name& name, std::size_t most, const std::string& text) {
  for (std::size_t k = 1; k <= most; ++k) {
    const int file = ::open(name(k).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0) throw JobError(JobEnd::kTryAgain, name(k) + ": cannot be written: " + std::strerror(errno));
    [[maybe_unused]] const ssize_t ignored = ::write(file, text.data(), text.size());
    ::close(file);
    return;
  }
}

}  // namespace

std::vector<std::string> JobFolder::failures(std::size_t task) const {
  const std::string failed = name_path("failed", task);
  std::vector<std::string> messages;
  const auto add = [&](const std::string& path) {
    if (is_there(path)) messages.push_back(read_text(path));
  };
  add(refusal(failed));
  for (std::size_t k = 1; k <= kMostFailures; ++k) add(failure(failed, k));
  for (std::size_t k = 1; k <= kMostVanished; ++k) add(vanished(failed, k));
  return messages;
}

bool JobFolder::is_set_aside(std::size_t task) const {
  const std::string failed = name_path("failed", task);
  return is_there(refusal(failed)) || is_there(failure(failed, kMostFailures)) ||
         is_there(vanished(failed, kMostVanished));
}

void JobFolder::fail(std::size_t task, const std::string& message, bool refused) const {
  const std::string failed = name_path("failed", task);
  if (refused) return write_next([&](std::size_t) { return refusal(failed); }, 1, message);
  write_next([&](std::size_t k) { return failure(failed, k); }, kMostFailures, message);
}

void JobFolder::forget_failures() const {
  std::error_code ignored;
  for (const std::string& name : names_in(path_ + "/failed"))
    if (!name.ends_with(".other")) fs::remove(path_ + "/failed/" + name, ignored);
}

void JobFolder::note_time(std::size_t task, double seconds, std::uint64_t peak_bytes) const {
  const Document note{{"seconds", seconds}, {"peak_memory_bytes", peak_bytes}, {"runner", runner_name()}};
  // Another machine may note the same task at the same time.
  Unfinished file(fmt::format("{}.time.{}", name_path("tmp", task), runner_name()));
  write_file(file.path(), json_text(note) + "\n", false);
  const std::string path = name_path("stats", task) + ".json";
  file.finish([&] {
    if (std::rename(file.path().c_str(), path.c_str()) != 0)
      throw JobError(JobEnd::kTryAgain, path + ": cannot be written: " + std::strerror(errno));
  });
}

double JobFolder::seconds_spent() const {
  double seconds = 0;
  for (const std::string& name : names_in(path_ + "/stats")) {
    const std::string path = path_ + "/stats/" + name;
    if (name.ends_with(".json")) seconds += parsed(path, read_text(path)).value("seconds", 0.0);
  }
  return seconds;
}

template <class Stale>
std::vector<JobFolder::Claim> JobFolder::claims_but(double patience, const Stale& stale) const {
  std::vector<Claim> claims;
  const std::vector<std::string> names = names_in(path_ + "/claims");
  if (names.empty()) return claims;
  const double now = time_of_server(path_);
  for (const std::string& name : names) {
    const std::string path = path_ + "/claims/" + name;
    const auto task = task_of(name);
    const auto touched = touched_at(path);
    if (!task || !touched) continue;
    Claim claim{*task, name.substr(name.find('.') + 1)};
    if (now - *touched > patience)
      stale(path, claim);
    else
      claims.push_back(std::move(claim));
  }
  return claims;
}

std::vector<JobFolder::Claim> JobFolder::claims(double patience) const {
  return claims_but(patience, [](const std::string&, const Claim&) {});
}

std::string JobFolder::first_claim(std::size_t task) const {
  std::pair<double, std::string> first{std::numeric_limits<double>::infinity(), ""};
  for (const std::string& name : names_in(path_ + "/claims")) {
    if (task_of(name) != task) continue;
    const std::string path = path_ + "/claims/" + name;
    // The least name counts as the first among claims of the same moment.
    if (const auto touched = touched_at(path)) first = std::min(first, {*touched, path});
  }
  return first.second;
}

/// Removes what a runner was writing in tmp/. The names of its files end as its own does; one that is not complete, of
/// which the name begins with a dot, has a number of its process within.
void JobFolder::remove_unfinished_of(const std::string& runner) const {
  const fs::path name = runner;
  std::error_code error;
  std::vector<fs::path> left;
  for (fs::directory_iterator at(path_ + "/tmp", error), end; !error && at != end; at.increment(error)) {
    const std::string file = at->path().filename().string();
    const bool complete = file.ends_with("." + runner);
    const bool begun = file.front() == '.' && file.find("." + name.stem().string() + ".part") != std::string::npos &&
                       file.ends_with(name.extension().string());
    if (complete || begun) left.push_back(at->path());
  }
  for (const fs::path& file : left) fs::remove(file, error);
}

std::vector<JobFolder::Claim> JobFolder::clear_claims(double patience) const {
  return claims_but(patience, [&](const std::string& path, const Claim& claim) {
    // The one of several that removes it notes it.
    if (::unlink(path.c_str()) != 0) return;
    remove_unfinished_of(claim.runner);
    if (is_done(claim.task)) return;
    const std::string failed = name_path("failed", claim.task);
    write_next([&](std::size_t k) { return vanished(failed, k); }, kMostVanished,
               fmt::format("the runner {} vanished", claim.runner));
  });
}

}  // namespace itin::viewshed
