// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/program_process.hpp"

#include <sys/personality.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/program_path.hpp"
#include "fibers/posix/traps/watched_code.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/own_command_line.hpp"
#include "tools/exec/access_instructions.hpp"
#include "tools/exec/linked_libraries.hpp"
#include "tools/exec/program_file.hpp"

namespace waitpoint::tools {
namespace {

std::string put_first(const std::string& variable, const std::string& path) {
  const char* const others = std::getenv(variable.c_str());
  return variable + "=" + (others != nullptr ? path + ":" + others : path);
}

[[noreturn]] void become(const ProgramFiles& files, const RunMemory& memory, OutputStreams streams) {
  if (streams.output >= 0) dup2(streams.output, STDOUT_FILENO);
  if (streams.errors >= 0) dup2(streams.errors, STDERR_FILENO);
  // A program without its supervisor must not continue.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Programs order and hash by addresses: equal runs need equal addresses.
  const int persona = personality(0xFFFFFFFF);
  if (persona >= 0) personality(static_cast<unsigned long>(persona) | ADDR_NO_RANDOMIZE);
  static std::vector<std::string> environment = environment_of(files, memory);
  for (std::string& variable : environment) putenv(variable.data());
  execv(files.program.c_str(), pointers(files.words).data());
  std::fprintf(stderr, "waitpoint: exec: %s: %s\n", files.program.c_str(), std::strerror(errno));
  _exit(exec_failed);
}

// The path of a program that can be simulated.
std::filesystem::path checked_program(const std::string& name) {
  std::filesystem::path program = find_program(name);
  if (program.empty() && name.find('/') != std::string::npos && std::filesystem::exists(name))
    throw BadInput("exec", "'" + name + "' is not an executable file");
  if (program.empty()) throw BadInput("exec", "there is no program '" + name + "'");
  if (const std::string reason = cannot_be_simulated(program); !reason.empty())
    throw BadInput("exec", program.string() + " " + reason);
  return program;
}

}  // namespace

ProgramFiles::ProgramFiles(const std::vector<std::string>& given, bool quiet, SwitchAt at,
                           const std::vector<std::string>& named)
    : programs(given), library(find_part("libwaitpoint-exec.so")) {
  const std::filesystem::path loader = find_part("waitpoint-load");
  for (const ProgramList::Program& one : programs.programs())
    if (!is_shared_object(one.words.front())) program = checked_program(one.words.front());
  if (programs.is_session()) {
    program = find_part("waitpoint-session");
    words = programs.words_of_session(loader, quiet);
    words.insert(words.begin(), program.filename());
    return;
  }
  words = programs.programs().front().words;
  if (program.empty()) {
    program = loader;
    words.insert(words.begin(), programs.title());
  }
  instrumented = is_instrumented(program);
  if (instrumented) (void)find_part("libtsan.so.2");  // the program would not start without it
  if (!instrumented && at == SwitchAt::accesses && program != loader) {
    accesses = access_instructions(program);
    add_libraries(named);
  }
  if (watches_accesses()) library = find_part("libwaitpoint-exec-races.so");
}

void ProgramFiles::add_libraries(const std::vector<std::string>& named) {
  const std::vector<LinkedLibrary> watched = watched_libraries(program, library, named);
  if (watched.size() >= posix::WatchedCode::modules_max)
    throw BadInput("--switch-at", "expected at most " + std::to_string(posix::WatchedCode::modules_max - 1) +
                                      " libraries, found " + std::to_string(watched.size()));
  for (const LinkedLibrary& one : watched) {
    struct stat of {};
    if (stat(one.file.c_str(), &of) != 0) throw BadInput("--switch-at", one.file.string() + " cannot be read");
    libraries.push_back({of.st_dev, of.st_ino});
    const std::vector<posix::AccessInstruction> found = access_instructions(one.file, libraries.size());
    accesses.insert(accesses.end(), found.begin(), found.end());
  }
}

std::vector<std::string> ProgramFiles::named() const {
  std::vector<std::string> all;
  for (const ProgramList::Program& one : programs.programs()) {
    const std::string& file = one.words.front();
    all.push_back(is_shared_object(file) ? file : find_program(file).string());
  }
  return all;
}

std::vector<std::string> environment_of(const ProgramFiles& files, const RunMemory& memory) {
  std::vector<std::string> environment = {
      put_first("LD_PRELOAD", files.library.string()),
      std::string(posix::record_variable) + "=" + std::to_string(memory.descriptor()),
  };
  // That folder has an empty library in place of the compiler's own runtime.
  if (files.instrumented) environment.push_back(put_first("LD_LIBRARY_PATH", files.library.parent_path().string()));
  return environment;
}

pid_t start_program(const ProgramFiles& files, const RunMemory& memory, OutputStreams streams) {
  std::fflush(nullptr);
  const pid_t process = fork();
  if (process < 0) throw BadInput("exec", std::string("cannot create a process: ") + std::strerror(errno));
  if (process == 0) become(files, memory, streams);
  return process;
}

}  // namespace waitpoint::tools
