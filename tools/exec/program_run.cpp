// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_run.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "tools/data_folder.hpp"
#include "tools/exec/exec.hpp"
#include "tools/exec/program_file.hpp"
#include "tools/exec/watchdog.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path find_library() {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const char name[] = "libwaitpoint-exec.so";
  const std::filesystem::path installed = std::filesystem::path(library_folder) / name;
  for (const std::filesystem::path& place : {folder / ".." / name, installed})
    if (std::filesystem::exists(place)) return std::filesystem::canonical(place);
  throw BadInput("exec", "the library for programs is not installed: expected " + installed.string());
}

[[noreturn]] void become(const ExecOptions& options, const ProgramFiles& files, int descriptor, int output) {
  const std::string preloaded = files.library.string();
  if (output >= 0) {
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
  }
  // Who is not watched over any more is not to run on.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Equal runs have equal addresses: programs order and hash by them.
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  const char* const others = std::getenv("LD_PRELOAD");
  setenv("LD_PRELOAD", (others != nullptr ? preloaded + ":" + others : preloaded).c_str(), 1);
  setenv(posix::record_variable, std::to_string(descriptor).c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : options.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(files.program.c_str(), words.data());
  std::fprintf(stderr, "waitpoint: exec: %s: %s\n", files.program.c_str(), std::strerror(errno));
  _exit(exec_failed);
}

constexpr int looks_ms = 1000;

pid_t child = 0;
void pass_on(int signal) { kill(child, signal); }

/// Signals of the terminal go to the program too, and it decides; others are passed on to it.
int wait_for_end(Watchdog watchdog) {
  signal(SIGINT, SIG_IGN);
  signal(SIGQUIT, SIG_IGN);
  for (const int signal : {SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) std::signal(signal, pass_on);
  int status = 0;
  const int end = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  for (pollfd one{end, POLLIN, 0}; end >= 0 && poll(&one, 1, looks_ms) <= 0;) watchdog.look();
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2}) std::signal(signal, SIG_DFL);
  return status;
}

[[noreturn]] void no_memory() { throw BadInput("exec", std::string("no memory to share: ") + std::strerror(errno)); }

}  // namespace

ProgramFiles::ProgramFiles(const std::string& name) : program(find_program(name)) {
  if (program.empty()) throw BadInput("exec", "there is no program '" + name + "'");
  if (const std::string reason = cannot_be_simulated(program); !reason.empty())
    throw BadInput("exec", program.string() + " " + reason);
  library = find_library();
}

ProgramRun::ProgramRun(const ExecOptions& options, const ProgramFiles& files, std::uint64_t seed, int output) {
  descriptor_ = memfd_create("waitpoint-exec", 0);
  if (descriptor_ < 0 || ftruncate(descriptor_, sizeof(posix::Record)) != 0) no_memory();
  void* memory = mmap(nullptr, sizeof(posix::Record), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (memory == MAP_FAILED) no_memory();
  record_ = new (memory) posix::Record();
  record_->settings = {options.order, seed};
  std::fflush(nullptr);
  child = fork();
  if (child < 0) throw BadInput("exec", std::string("no process can be made: ") + std::strerror(errno));
  if (child == 0) become(options, files, descriptor_, output);
  status_ = wait_for_end(Watchdog(*record_, child));
}

ProgramRun::~ProgramRun() {
  munmap(record_, sizeof(posix::Record));
  close(descriptor_);
}

int ProgramRun::exit_status() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }
int ProgramRun::signal() const { return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0; }

}  // namespace waitpoint::tools
