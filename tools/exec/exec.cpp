// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/exec.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "fibers/posix/record.hpp"
#include "tools/data_folder.hpp"
#include "tools/exec/program_file.hpp"
#include "tools/exec/watchdog.hpp"

namespace waitpoint::tools {
namespace {

std::filesystem::path library() {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const char name[] = "libwaitpoint-exec.so";
  const std::filesystem::path installed = std::filesystem::path(library_folder) / name;
  for (const std::filesystem::path& place : {folder / ".." / name, installed})
    if (std::filesystem::exists(place)) return std::filesystem::canonical(place);
  throw BadInput("exec", "the library for programs is not installed: expected " + installed.string());
}

/// A record in memory, which the program maps by its descriptor.
class SharedRecord {
 public:
  explicit SharedRecord(const ExecOptions& options) {
    descriptor_ = memfd_create("waitpoint-exec", 0);
    if (descriptor_ < 0 || ftruncate(descriptor_, sizeof(posix::Record)) != 0) fail();
    void* memory = mmap(nullptr, sizeof(posix::Record), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
    if (memory == MAP_FAILED) fail();
    record_ = new (memory) posix::Record();
    record_->settings = {options.order, options.seed};
  }
  SharedRecord(const SharedRecord&) = delete;
  SharedRecord& operator=(const SharedRecord&) = delete;

  int descriptor() const { return descriptor_; }
  const posix::Record& operator*() const { return *record_; }
  const posix::Record* operator->() const { return record_; }

 private:
  [[noreturn]] static void fail() {
    throw BadInput("exec", std::string("no memory to share: ") + std::strerror(errno));
  }

  int descriptor_;
  posix::Record* record_;
};

std::string quoted(const std::string& word) {
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%") ==
          std::string::npos)
    return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string replay_line(const ExecOptions& options) {
  std::string line = "waitpoint exec --seed " + std::to_string(options.seed);
  if (options.order == kernel::Order::fifo) line += " --strategy fifo";
  line += " --";
  for (const std::string& word : options.words) line += " " + quoted(word);
  return line;
}

[[noreturn]] void become(const ExecOptions& options, const std::filesystem::path& program, const std::string& preloaded,
                         int descriptor) {
  // Equal runs have equal addresses: programs order and hash by them.
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  const char* const others = std::getenv("LD_PRELOAD");
  setenv("LD_PRELOAD", (others != nullptr ? preloaded + ":" + others : preloaded).c_str(), 1);
  setenv(posix::record_variable, std::to_string(descriptor).c_str(), 1);
  std::vector<char*> words;
  for (const std::string& word : options.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  std::fprintf(stderr, "waitpoint: exec: %s: %s\n", program.c_str(), std::strerror(errno));
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

void print_summary(const posix::Record& record, const std::string& program) {
  const kernel::Scheduler& scheduler = record.scheduler;
  std::fprintf(
      stderr, "waitpoint: %s: %u threads, %u at once, %llu events, %llu switches, %s s of virtual time, digest %s\n",
      program.c_str(), record.threads_made, record.threads_most, static_cast<unsigned long long>(scheduler.events()),
      static_cast<unsigned long long>(scheduler.switches()), to_string(scheduler.global_time()).c_str(),
      to_string(record.robot.digest.digest()).c_str());
}

/// As a shell sees the program itself.
[[noreturn]] void end_by(int signal) {
  const rlimit no_second_core{};
  setrlimit(RLIMIT_CORE, &no_second_core);
  std::signal(signal, SIG_DFL);
  raise(signal);
  std::exit(128 + signal);
}

}  // namespace

int exec(const ExecOptions& options) {
  const std::filesystem::path program = find_program(options.words.front());
  if (program.empty()) throw BadInput("exec", "there is no program '" + options.words.front() + "'");
  if (const std::string reason = cannot_be_simulated(program); !reason.empty())
    throw BadInput("exec", program.string() + " " + reason);
  const std::string preloaded = library().string();
  const SharedRecord record(options);
  std::fflush(nullptr);
  child = fork();
  if (child < 0) throw BadInput("exec", std::string("no process can be made: ") + std::strerror(errno));
  if (child == 0) become(options, program, preloaded, record.descriptor());
  const int status = wait_for_end(Watchdog(*record, child));
  const int own = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  if (record->began) {
    const bool failed = WIFSIGNALED(status) || own == posix::status_of_deadlock;
    if (!options.quiet || failed) print_summary(*record, program.filename().string());
    if (WIFSIGNALED(status))
      std::fprintf(stderr, "waitpoint: it was ended by signal %d (%s)\n", WTERMSIG(status),
                   strsignal(WTERMSIG(status)));
    if (failed) std::fprintf(stderr, "waitpoint: replay: %s\n", replay_line(options).c_str());
  }
  if (WIFSIGNALED(status)) end_by(WTERMSIG(status));
  return own;
}

}  // namespace waitpoint::tools
