// SPDX-License-Identifier: BSD-3-Clause
#include "tests/runs/program.hpp"
#include "tests/project.hpp"

#include <sys/personality.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "tests/runs/shipped.hpp"

namespace waitpoint::runs {
namespace {

std::string contents(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char part[4096];
  while (const std::size_t got = std::fread(part, 1, sizeof part, file)) text.append(part, got);
  std::fclose(file);
  return text;
}

// A file with this content, positioned at its beginning.
int file_of(const std::string& text) {
  std::FILE* file = std::tmpfile();
  if (file == nullptr || std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0)
    return -1;
  std::rewind(file);
  return fileno(file);
}

// In the child: executes the command or exits.
[[noreturn]] void become(const Command& command) {
  for (const std::string& assignment : command.environment) putenv(const_cast<char*>(assignment.c_str()));
  if (!command.folder.empty() && chdir(command.folder.c_str()) != 0) _exit(126);
  if (!command.input.empty() && dup2(file_of(command.input), STDIN_FILENO) < 0) _exit(126);
  if (!command.random_addresses) personality(ADDR_NO_RANDOMIZE);
  std::vector<char*> words;
  for (const std::string& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

}  // namespace

std::filesystem::path program() {
  if (const char* given = std::getenv("WAITPOINT_PROGRAM"); given != nullptr && *given != '\0')
    return std::filesystem::absolute(given);
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "../tools/waitpoint";
}

Process::Process(const Command& command) : output_(std::tmpfile()), errors_(std::tmpfile()) {
  if (output_ == nullptr || errors_ == nullptr) throw std::runtime_error("no temporary file can be had");
  std::fflush(nullptr);
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("no process can be had");
  if (id_ > 0) return;
  dup2(fileno(output_), STDOUT_FILENO);
  dup2(fileno(errors_), STDERR_FILENO);
  become(command);
}

Process::~Process() {
  if (id_ > 0) wait();
}

Outcome Process::wait() {
  int status = 0;
  while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
  Outcome outcome;
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.output = contents(output_);
  outcome.errors = contents(errors_);
  return outcome;
}

std::string Outcome::digest() const {
  const std::size_t at = output.rfind("wp1:");
  return at == std::string::npos ? "" : output.substr(at, 20);
}

Command run_command(const std::string& scenario, const std::string& until_s, const std::vector<std::string>& more) {
  Command command{{program(), "run", test::project_root() / "scenarios" / scenario, "--until", until_s}};
  command.words.insert(command.words.end(), more.begin(), more.end());
  return command;
}

}  // namespace waitpoint::runs
