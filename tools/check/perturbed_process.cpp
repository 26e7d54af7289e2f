// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check/perturbed_process.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cfenv>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <string_view>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "tools/check/surroundings_file.hpp"
#include "tools/command/own_command_line.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* program_file = "/proc/self/exe";

[[noreturn]] void fail(const char* what) {
  throw BadInput("--verify", std::string(what) + ": " + std::strerror(errno));
}

/// A memory file that the new process opens by its descriptor.
int surroundings_library() {
  const int file = memfd_create("waitpoint-surroundings", 0);
  if (file < 0) fail("cannot create a memory file");
  const std::span<const unsigned char> bytes = surroundings_file();
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written <= 0) fail("cannot write a memory file");
    done += static_cast<std::size_t>(written);
  }
  return file;
}

/// The LD_PRELOAD with the object of that descriptor in front, but after a sanitizer's runtime, which must come first.
std::string preloaded(int object) {
  std::string files;
  for (const char* entry : {"__asan_init", "__tsan_init"}) {
    void* const runtime = dlsym(RTLD_DEFAULT, entry);
    Dl_info found{};
    if (runtime == nullptr || dladdr(runtime, &found) == 0) continue;
    if (std::string_view(found.dli_fname).find(".so") != std::string_view::npos)
      files += found.dli_fname + std::string(":");
  }
  files += "/proc/self/fd/" + std::to_string(object);
  const char* const others = std::getenv("LD_PRELOAD");
  return files + (others != nullptr && *others != '\0' ? std::string(":") + others : "");
}

std::string other(const char* name, const char* one, const char* another) {
  const char* const old = std::getenv(name);
  return std::string(name) + "=" + (old != nullptr && std::string_view(old) == one ? another : one);
}

std::vector<std::string> other_environment(const PerturbedFiles& files, int preload) {
  std::vector<std::string> variables = {
      "LD_PRELOAD=" + preloaded(preload),
      fmt::format("{}={},{}", check_variable, files.log, files.durations),
      "MALLOC_TOP_PAD_=1183744",
      other("LC_ALL", "C.UTF-8", "C"),
      other("LANG", "C.UTF-8", "C"),
      other("TZ", "<+0545>-5:45", "<-0330>3:30"),
      other("USER", "somebody", "another"),
      other("LOGNAME", "somebody", "another"),
      other("HOSTNAME", "somewhere", "elsewhere"),
      other("TERM", "dumb", "vt100"),
      other("COLUMNS", "61", "163"),
      other("LINES", "17", "71"),
      "A_VARIABLE_MORE=" + std::string(3331, 'x'),  // moves the stack, too
  };
  const std::vector<std::string> changed = variables;
  for (char** at = environ; *at != nullptr; ++at) {
    const std::string_view variable = *at;
    const std::string_view name = variable.substr(0, variable.find('=') + 1);
    const bool known =
        std::any_of(changed.begin(), changed.end(), [&](const std::string& mine) { return mine.starts_with(name); });
    if (!known) variables.emplace_back(variable);
  }
  std::reverse(variables.begin(), variables.end());
  return variables;
}

// In the new process, which has one thread and is killed with its parent.
[[noreturn]] void become(const PerturbedFiles& files, char* const* words, char* const* variables) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  fcntl(files.log, F_SETFD, 0);
  if (files.durations >= 0) fcntl(files.durations, F_SETFD, 0);
  const int old = personality(0xFFFFFFFF);
  if (old >= 0) personality(static_cast<unsigned long>(old) & ~static_cast<unsigned long>(ADDR_NO_RANDOMIZE));
  execve(program_file, words, variables);
  _exit(127);
}

/// Stops a process by a signal first and by force later.
class Stopping {
 public:
  explicit Stopping(pid_t id) : id_(id) {}
  void ask() {
    if (asked_ == Clock::time_point()) {
      kill(id_, SIGTERM);
      asked_ = Clock::now();
    } else if (Clock::now() - asked_ > std::chrono::seconds(5)) {
      force();
    }
  }
  void force() const { kill(id_, SIGKILL); }

 private:
  using Clock = std::chrono::steady_clock;
  pid_t id_;
  Clock::time_point asked_;
};

}  // namespace

void check_perturbed_process_possible() {
  if (access(program_file, X_OK) != 0) fail("a perturbed process needs /proc, which cannot be read");
}

ProcessEnd run_perturbed_process(const PerturbedFiles& files, double limit_s, bool (*interrupted)()) {
  using Clock = std::chrono::steady_clock;
  const std::vector<std::string> words = own_command_line();
  if (words.empty()) fail("cannot read the command line");
  const int preload = surroundings_library();
  const std::vector<std::string> environment = other_environment(files, preload);
  const std::vector<char*> arguments = pointers(words), variables = pointers(environment);
  std::fflush(nullptr);
  const pid_t id = fork();
  if (id < 0) fail("cannot create a process");
  if (id == 0) become(files, arguments.data(), variables.data());
  close(preload);
  const Clock::time_point due =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit_s));
  Stopping stopping(id);
  bool late = false;
  int status = 0;
  for (;;) {
    const pid_t ended = waitpid(id, &status, WNOHANG);
    if (ended == id) break;
    if (ended < 0 && errno != EINTR) fail("cannot wait for the process");
    if (interrupted()) stopping.ask();
    late = late || Clock::now() > due;
    if (late) stopping.force();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (WIFEXITED(status)) return {WEXITSTATUS(status), ""};
  if (late) return {std::nullopt, fmt::format("exceeded {:.0f} s and was stopped", limit_s)};
  return {std::nullopt, fmt::format("was terminated by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))};
}

void perturb_surroundings() {
  constexpr int digits = 3;
  constexpr mode_t other_permissions = 027, usual = 022;
  std::setlocale(LC_ALL, std::string_view(std::setlocale(LC_ALL, nullptr)) == "C" ? "C.UTF-8" : "C");
  sigset_t unused;
  sigemptyset(&unused);
  sigaddset(&unused, SIGUSR2);
  pthread_sigmask(SIG_BLOCK, &unused, nullptr);
  if (umask(other_permissions) == other_permissions) umask(usual);
  for (std::ostream* const stream : {&std::cout, &std::cerr, &std::clog})
    *stream << std::hex << std::setprecision(digits);
  std::feraiseexcept(FE_ALL_EXCEPT);
}

std::optional<PerturbedFiles> files_of_perturbed_process() {
  const char* const text = std::getenv(check_variable);
  if (text == nullptr) return std::nullopt;
  const std::string_view all = text;
  const std::size_t comma = all.find(',');
  std::int64_t log = -1, durations = -1;
  if (comma == std::string_view::npos || !parse_number(all.substr(0, comma), log) ||
      !parse_number(all.substr(comma + 1), durations) || log < 0)
    throw BadInput(check_variable, "is reserved for the perturbed process of a self-check");
  return PerturbedFiles{static_cast<int>(log), static_cast<int>(durations)};
}

}  // namespace waitpoint::tools
