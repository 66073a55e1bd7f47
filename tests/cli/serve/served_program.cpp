#include "cli/serve/served_program.hpp"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <regex>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "cli/shell.hpp"

namespace itin::test {

namespace {

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    read = ends[0], write = ends[1];
  }
};

std::string line_from(int file) {
  std::string line;
  for (char c = 0; ::read(file, &c, 1) == 1 && c != '\n';) line += c;
  return line;
}

std::string rest_of(int file) {
  std::string rest;
  std::array<char, 4096> bytes{};
  for (ssize_t n = 0; (n = ::read(file, bytes.data(), bytes.size())) > 0;)
    rest.append(bytes.data(), static_cast<std::size_t>(n));
  return rest;
}

}  // namespace

ServedProgram::ServedProgram(const std::vector<std::string>& arguments) {
  const Pipe out, err;
  std::vector<std::string> words{"itin", "serve", "--port", "0"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.write, STDERR_FILENO);
  const int failure = posix_spawn(&process_, tested_program().c_str(), &files, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  close(out.write), close(err.write);
  if (failure != 0) throw std::runtime_error("no " + tested_program());
  errors_ = err.read;
  url_ = line_from(out.read);
  close(out.read);
  std::smatch match;
  if (!std::regex_match(url_, match, std::regex("http://.*:(\\d+)/#key=([0-9a-f]{32})"))) {
    const End told = end(SIGTERM);
    throw std::runtime_error("not served: " + url_ + told.errors);
  }
  port_ = static_cast<std::uint16_t>(std::stoi(match[1]));
  key_ = match[2];
}

ServedProgram::~ServedProgram() {
  if (process_ == 0) return;
  const End told = end(SIGTERM);
  EXPECT_EQ(told.status, 130) << told.errors;
}

ServedProgram::End ServedProgram::end(int signal) {
  kill(process_, signal);
  End told;
  told.errors = rest_of(errors_);
  close(errors_);
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = 0;
  told.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return told;
}

}  // namespace itin::test
