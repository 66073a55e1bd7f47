#include "serve/calls/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <itin/error.hpp>

namespace itin::cli {

namespace {

constexpr const char* kThisProgram = "/proc/self/exe";
constexpr int kLowerPriority = 10;
constexpr std::string_view kErrorLine = "itin: error: ";
constexpr int kFirstOtherFile = 3;  ///< behind standard input, output and error

/// What the system does between the fork and the start of the program.
class SpawnSteps {
 public:
  SpawnSteps(const std::string& folder, const std::string& output, int errors) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&files_, errors, STDERR_FILENO);
    posix_spawn_file_actions_addclosefrom_np(&files_, kFirstOtherFile);
    posix_spawn_file_actions_addchdir_np(&files_, folder.c_str());
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSteps() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSteps(const SpawnSteps&) = delete;
  SpawnSteps& operator=(const SpawnSteps&) = delete;

  /// Returns 0, or the number of an error.
  int spawn(pid_t& process, std::vector<char*>& arguments) {
    return posix_spawn(&process, kThisProgram, &files_, &attributes_, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::string& folder,
                           const std::string& output) {
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) throw Error(fmt::format("no job can be started: {}", std::strerror(errno)));
  std::vector<std::string> words{"itin"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int failure = SpawnSteps(folder, output, pipe[1]).spawn(process_, pointers);
  close(pipe[1]);
  errors_ = pipe[0];
  if (failure != 0) {
    close(errors_);
    throw Error(fmt::format("no job can be started: {}", std::strerror(failure)));
  }
  setpriority(PRIO_PROCESS, static_cast<id_t>(process_), kLowerPriority);
}

ChildProcess::~ChildProcess() {
  terminate();
  wait();
  close(errors_);
}

bool ChildProcess::read_line(std::string& line) {
  std::size_t end = 0;
  while ((end = read_.find('\n')) == std::string::npos) {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(errors_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    read_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  line = read_.substr(0, end);
  read_.erase(0, end + 1);
  return true;
}

int ChildProcess::wait() {
  siginfo_t ended{};
  if (process_ == 0) return 0;
  while (waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  const std::lock_guard lock(mutex_);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

CallEnd end_of(ChildProcess& process, const Progress& progress) {
  CallEnd end;
  for (std::string line; process.read_line(line); progress.throw_if_cancelled())
    end.error = told_error(line).value_or(end.error);
  end.status = process.wait();
  return end;
}

std::optional<std::string> told_error(const std::string& line) {
  return line.starts_with(kErrorLine) ? std::optional(line.substr(kErrorLine.size())) : std::nullopt;
}

void ChildProcess::terminate() {
  const std::lock_guard lock(mutex_);
  if (process_ != 0) kill(-process_, SIGTERM);
}

}  // namespace itin::cli
