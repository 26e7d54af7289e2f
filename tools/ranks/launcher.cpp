// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ranks/launcher.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "core/program_path.hpp"
#include "tools/command/own_command_line.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* pipe_variable = "WAITPOINT_LAUNCHER";  // the pipe, as a file of the launcher's
constexpr int not_yet = -1;

// Settings for which Open MPI 4 and 5 have different options, or none: a release passes over the parameters that it
// does not know.
constexpr std::pair<const char*, const char*> mpi_parameters[] = {
    {"btl", "^tcp"},                              // within this host, whatever its network
    {"btl_vader_single_copy_mechanism", "none"},  // shared memory, without a right to read another process's
    {"odls_base_sigkill_timeout", "2"},           // seconds to end in order, after an interruption
    {"orte_abort_on_non_zero_status", "0"},       // Open MPI 4
    {"state_base_error_non_zero_exit", "0"},      // Open MPI 5
    {"orte_execute_quiet", "1"},
};

/// A rank's notice to the launcher, in a single write.
struct Notice {
  pid_t process;
  int status;  ///< not_yet: it leads, and runs
};

int processors() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

int own_rank() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  return rank != nullptr ? std::atoi(rank) : 0;
}

std::vector<std::string> command_of(const std::string& mpirun, int ranks, std::span<const std::string> arguments) {
  std::vector<std::string> words{mpirun, "-n", std::to_string(ranks), "--enable-recovery"};
  for (const auto& [parameter, value] : mpi_parameters) words.insert(words.end(), {"--mca", parameter, value});
  if (ranks > processors()) words.insert(words.end(), {"--map-by", ":oversubscribe", "--bind-to", "none"});
  // The processes have this user's rights as the present one has.
  if (geteuid() == 0) words.emplace_back("--allow-run-as-root");
  words.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

[[noreturn]] void execute(const std::vector<std::string>& words, const sigset_t& signals, pid_t launcher) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != launcher) _exit(1);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  // Its library prints an error of its own for each process that is killed.
  setenv("PMIX_OUTPUT_REDIRECT", "syslog", 0);
  execv(words.front().c_str(), pointers(words).data());
  std::fprintf(stderr, "waitpoint: '%s' cannot be started: %s\n", words.front().c_str(), std::strerror(errno));
  _exit(2);
}

void notify(int status) {
  const char* const file = std::getenv(pipe_variable);
  const int pipe = file != nullptr ? open(file, O_WRONLY | O_CLOEXEC) : -1;
  if (pipe < 0) return;
  const Notice notice{getpid(), status};
  static_cast<void>(!write(pipe, &notice, sizeof notice));
  close(pipe);
}

/// The notices of the ranks so far.
class Notices {
 public:
  Notices() {
    if (pipe2(ends_, O_CLOEXEC | O_NONBLOCK) != 0) throw BadInput("--ranks", std::strerror(errno));
    setenv(pipe_variable, ("/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(ends_[1])).c_str(), 1);
  }
  ~Notices() {
    close(ends_[0]);
    close(ends_[1]);
  }
  Notices(const Notices&) = delete;
  Notices& operator=(const Notices&) = delete;

  void read_all() {
    for (Notice notice{}; read(ends_[0], &notice, sizeof notice) == sizeof notice;)
      if (notice.status == not_yet)
        leader_ = notice.process;
      else if (!status_)
        status_ = notice.status;
  }
  std::optional<pid_t> leader() const { return leader_; }
  std::optional<int> status() const { return status_; }

 private:
  int ends_[2];
  std::optional<pid_t> leader_;
  std::optional<int> status_;
};

int status_of(const Notices& notices, int of_mpirun, bool is_interrupted) {
  if (notices.status()) return *notices.status();
  if (is_interrupted) return 130;
  if (WIFEXITED(of_mpirun) && WEXITSTATUS(of_mpirun) != 0) return WEXITSTATUS(of_mpirun);
  std::fprintf(stderr, "waitpoint: the run failed: all its processes have ended without a result\n");
  return 1;
}

}  // namespace

bool is_rank() {
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr && std::atoi(size) > 1;
}

int run_ranks(int ranks, std::span<const std::string> arguments) {
  const std::string mpirun = find_program("mpirun").string();
  if (mpirun.empty()) throw BadInput("--ranks", std::string("there is no program 'mpirun': ") + missing_part::ranks);
  const std::vector<std::string> words = command_of(mpirun, ranks, arguments);
  Notices notices;
  sigset_t heeded, before;
  sigemptyset(&heeded);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&heeded, signal);
  sigprocmask(SIG_BLOCK, &heeded, &before);
  const pid_t self = getpid(), child = fork();
  if (child < 0) throw BadInput("--ranks", std::string("mpirun cannot be started: ") + std::strerror(errno));
  if (child == 0) execute(words, before, self);
  bool is_interrupted = false;
  int of_mpirun = 0;
  while (waitpid(child, &of_mpirun, WNOHANG) == 0) {
    siginfo_t info;
    const int signal = sigwaitinfo(&heeded, &info);
    if (signal < 0 || signal == SIGCHLD) continue;
    is_interrupted = true;
    // A terminal sends its own to mpirun, too.
    notices.read_all();
    if (info.si_code != SI_KERNEL) kill(notices.leader().value_or(child), signal);
  }
  notices.read_all();
  return status_of(notices, of_mpirun, is_interrupted);
}

void tell_launcher_of_leader() {
  if (own_rank() == 0) notify(not_yet);
}

int give_status(int status) {
  if (!is_rank() || std::getenv(pipe_variable) == nullptr) return status;
  if (own_rank() == 0 || status != 0) notify(status);
  return 0;
}

}  // namespace waitpoint::tools
