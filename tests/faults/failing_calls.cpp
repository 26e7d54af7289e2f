// SPDX-License-Identifier: BSD-3-Clause
// Runs a command in which a system call on a file of a folder fails:
//
//   failing-calls FOLDER LOG POSITION EFFECT COMMAND...
//
// Numbers the calls that create, write, position, close, name or lock files of the folder, from 1 on, and writes a line
// for each to LOG: "write out.json". The call at POSITION (0: none) has EFFECT, the name of an error, or "short": only
// half of the data is written; with a plus ("ENOSPC+") later calls of the kind have it, too. The failing call is not
// executed, except close(), which closes in any case. A tracer sees all calls of the process, also those within
// libraries, where replaced functions would not be called. The exit status is the command's, or 128 plus its signal.
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

namespace {

enum class Names { descriptor, path, path_at };

struct Kind {
  long call;
  const char* name;
  Names file;  ///< how the first or second argument names it
};
constexpr Kind kinds[] = {
    {SYS_open, "open", Names::path},          {SYS_creat, "open", Names::path},
    {SYS_openat, "open", Names::path_at},     {SYS_write, "write", Names::descriptor},
    {SYS_writev, "write", Names::descriptor}, {SYS_pwrite64, "write", Names::descriptor},
    {SYS_lseek, "lseek", Names::descriptor},  {SYS_ftruncate, "ftruncate", Names::descriptor},
    {SYS_fsync, "sync", Names::descriptor},   {SYS_fdatasync, "sync", Names::descriptor},
    {SYS_fchmod, "chmod", Names::descriptor}, {SYS_flock, "flock", Names::descriptor},
    {SYS_close, "close", Names::descriptor},  {SYS_rename, "rename", Names::path},
    {SYS_renameat, "rename", Names::path_at}, {SYS_renameat2, "rename", Names::path_at},
};

struct Error {
  const char* name;
  int number;
};
constexpr Error errors[] = {
    {"EACCES", EACCES}, {"EDQUOT", EDQUOT}, {"EFBIG", EFBIG},   {"EINTR", EINTR}, {"EINVAL", EINVAL},
    {"EIO", EIO},       {"ENFILE", ENFILE}, {"ENOLCK", ENOLCK}, {"EROFS", EROFS}, {"ENOSPC", ENOSPC},
};

using Registers = user_regs_struct;

std::string string_of(pid_t process, unsigned long long address) {
  std::array<char, PATH_MAX> text{};
  // In two parts, as the page behind the text may not be there.
  constexpr std::size_t page = 4096;
  const std::size_t near = std::min<std::size_t>(text.size() - 1, page - address % page), far = text.size() - 1 - near;
  const iovec to{text.data(), text.size() - 1};
  const std::array<iovec, 2> from{
      {{reinterpret_cast<void*>(address), near}, {reinterpret_cast<void*>(address + near), far}}};
  return process_vm_readv(process, &to, 1, from.data(), from.size(), 0) > 0 ? std::string(text.data()) : std::string();
}

std::string link_of(pid_t process, const std::string& name) {
  std::array<char, PATH_MAX> text{};
  const std::string link = "/proc/" + std::to_string(process) + "/" + name;
  const ssize_t size = readlink(link.c_str(), text.data(), text.size());
  return size > 0 ? std::string(text.data(), static_cast<std::size_t>(size)) : std::string();
}

std::string path_of(pid_t process, const Kind& kind, const Registers& registers) {
  if (kind.file == Names::descriptor) return link_of(process, "fd/" + std::to_string(static_cast<int>(registers.rdi)));
  const std::string path = string_of(process, kind.file == Names::path ? registers.rdi : registers.rsi);
  return path.starts_with('/') ? path : link_of(process, "cwd") + "/" + path;
}

class Tracer {
 public:
  Tracer(std::string folder, const char* log, unsigned long position, std::string effect)
      : folder_(std::move(folder) + "/"), log_(log), position_(position), effect_(std::move(effect)) {
    is_lasting_ = effect_.ends_with('+');
    if (is_lasting_) effect_.pop_back();
    for (const Error& error : errors)
      if (effect_ == error.name) error_ = error.number;
  }

  /// Until `process` ends; its wait status.
  int follow(pid_t process) {
    for (;;) {
      int status = 0;
      const pid_t stopped = waitpid(-1, &status, __WALL);
      if (stopped < 0) return -1;
      if (WIFEXITED(status) || WIFSIGNALED(status)) {
        if (stopped == process) return status;
        continue;
      }
      proceed(stopped, status);
    }
  }

 private:
  void proceed(pid_t task, int status) {
    int signal = WSTOPSIG(status);
    __ptrace_request how = PTRACE_CONT;
    if (status >> 8 == (SIGTRAP | (PTRACE_EVENT_SECCOMP << 8))) {
      if (!enter(task)) how = PTRACE_SYSCALL;
    } else if (signal == (SIGTRAP | 0x80)) {
      leave(task);
    } else if (status >> 16 == 0 && signal != SIGTRAP && signal != SIGSTOP) {
      ptrace(how, task, nullptr, signal);
      return;
    }
    ptrace(how, task, nullptr, nullptr);
  }

  /// At a call's begin. False if its result is to be changed.
  bool enter(pid_t task) {
    Registers registers{};
    ptrace(PTRACE_GETREGS, task, nullptr, &registers);
    for (const Kind& kind : kinds) {
      if (static_cast<long>(registers.orig_rax) != kind.call) continue;
      const std::string path = path_of(task, kind, registers);
      if (!path.starts_with(folder_) || is_reading(kind, registers)) return true;
      log_ << kind.name << ' ' << path.substr(folder_.size()) << '\n' << std::flush;
      ++calls_;
      if (calls_ == position_) failing_ = kind.name;
      const bool fails = calls_ == position_ || (is_lasting_ && calls_ > position_ && failing_ == kind.name);
      return !fails || fail(task, kind, registers);
    }
    return true;
  }

  static bool is_reading(const Kind& kind, const Registers& registers) {
    if (kind.call != SYS_open && kind.call != SYS_openat) return false;
    return ((kind.call == SYS_open ? registers.rsi : registers.rdx) & O_ACCMODE) == O_RDONLY;
  }

  bool fail(pid_t task, const Kind& kind, Registers& registers) const {
    if (effect_ == "short") {
      if (kind.call == SYS_write || kind.call == SYS_pwrite64) registers.rdx = (registers.rdx + 1) / 2;
    } else if (kind.call == SYS_close) {
      return false;
    } else {
      registers.orig_rax = static_cast<unsigned long long>(-1);  // no call
      registers.rax = static_cast<unsigned long long>(-static_cast<long long>(error_));
    }
    ptrace(PTRACE_SETREGS, task, nullptr, &registers);
    return true;
  }

  void leave(pid_t task) const {
    Registers registers{};
    ptrace(PTRACE_GETREGS, task, nullptr, &registers);
    registers.rax = static_cast<unsigned long long>(-static_cast<long long>(error_));
    ptrace(PTRACE_SETREGS, task, nullptr, &registers);
  }

  std::string folder_;
  std::ofstream log_;
  unsigned long position_, calls_ = 0;
  std::string effect_, failing_;
  bool is_lasting_ = false;
  int error_ = EIO;
};

/// Only the calls of interest stop the process.
void filter_calls() {
  std::array<sock_filter, std::size(kinds) + 3> filter{};
  std::size_t at = 0;
  filter[at++] = BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr));
  for (std::size_t i = 0; i < std::size(kinds); ++i) {
    const auto to_trace = static_cast<unsigned char>(std::size(kinds) - i);
    filter[at++] = BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(kinds[i].call), to_trace, 0);
  }
  filter[at++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW);
  filter[at++] = BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRACE);
  const sock_fprog program{static_cast<unsigned short>(at), filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    _exit(77);
}

[[noreturn]] void begin(char** command) {
  if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(77);
  raise(SIGSTOP);
  filter_calls();
  execvp(command[0], command);
  std::perror(command[0]);
  _exit(77);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int first_of_command = 5, not_possible = 77;
  if (argc <= first_of_command) {
    std::fputs("usage: failing-calls FOLDER LOG POSITION EFFECT COMMAND...\n", stderr);
    return 2;
  }
  const pid_t process = fork();
  if (process == 0) begin(argv + first_of_command);
  int status = 0;
  if (process < 0 || waitpid(process, &status, 0) < 0 || !WIFSTOPPED(status)) return not_possible;
  const long options = PTRACE_O_EXITKILL | PTRACE_O_TRACESECCOMP | PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE |
                       PTRACE_O_TRACEFORK | PTRACE_O_TRACEVFORK;
  if (ptrace(PTRACE_SETOPTIONS, process, nullptr, options) != 0) return not_possible;
  ptrace(PTRACE_CONT, process, nullptr, nullptr);
  Tracer tracer(argv[1], argv[2], std::strtoul(argv[3], nullptr, 10), argv[4]);
  status = tracer.follow(process);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
