// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ranks/joined_ranks.hpp"

#include <dlfcn.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"
#include "core/program_path.hpp"
#include "fibers/sync/system_calls.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/interruption.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* library = "libwaitpoint-mpi.so";
constexpr const char* packages = "install openmpi-bin and libopenmpi-dev, and build waitpoint again";

std::string library_path() {
  try {
    return find_part(library).string();
  } catch (const BadInput&) {
    throw BadInput("--ranks", std::string("ranks are not in this program: ") + packages);
  }
}

int processors() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace

bool is_rank() {
  const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr && std::atoi(size) > 1;
}

void start_ranks(int ranks, std::span<const std::string> arguments) {
  (void)library_path();
  const std::string mpirun = find_program("mpirun").string();
  if (mpirun.empty()) throw BadInput("--ranks", std::string("there is no program 'mpirun': ") + packages);
  const std::string number = std::to_string(ranks), self = std::filesystem::read_symlink("/proc/self/exe").string();
  // Messages by copies within shared memory, without a right to read another process's; a second to end in order.
  std::vector<const char*> words{mpirun.c_str(), "--quiet", "-n", number.c_str()};
  words.insert(words.end(), {"--mca", "btl_vader_single_copy_mechanism", "none"});
  words.insert(words.end(), {"--mca", "odls_base_sigkill_timeout", "2"});
  if (ranks > processors()) words.insert(words.end(), {"--oversubscribe", "--bind-to", "none"});
  // The processes have this user's rights as the present one has.
  if (geteuid() == 0) words.push_back("--allow-run-as-root");
  words.push_back(self.c_str());
  for (const std::string& argument : arguments) words.push_back(argument.c_str());
  words.push_back(nullptr);
  execv(mpirun.c_str(), const_cast<char* const*>(words.data()));
  throw BadInput("--ranks", "'" + mpirun + "' cannot be started: " + std::strerror(errno));
}

std::unique_ptr<run::Transport> join_ranks(int wanted) {
  const sync::UnnotedThreads progress_of_mpi;
  // Open MPI's own plugins look for its symbols among the global ones.
  void* const loaded = dlopen(library_path().c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (loaded == nullptr) throw BadInput("--ranks", std::string("the library for ranks cannot be loaded: ") + dlerror());
  auto* const join = reinterpret_cast<run::Transport* (*)()>(dlsym(loaded, "waitpoint_join_ranks"));
  if (join == nullptr) throw BadInput("--ranks", "the library for ranks is of another version");
  std::unique_ptr<run::Transport> transport(join());
  if (wanted != 1 && wanted != transport->ranks())
    throw BadInput("--ranks", "expected " + std::to_string(transport->ranks()) +
                                  ", as many as mpirun has started, found " + std::to_string(wanted));
  return transport;
}

run::Ranks::Waiting watch_over(run::Transport& transport, double limit_s) {
  return [&transport, limit_s, told_s = 0.0, interrupted_s = 0.0](double seconds, const std::string& where) mutable {
    // The launcher interrupts all when one has ended, and the user one that leads, which then ends all in order.
    constexpr double leads_s = 0.4, follows_s = 0.9, first_told_s = 5;
    const double now_s = wall_clock_s();
    if (interruption() == 0) interrupted_s = now_s;
    const double since_s = now_s - interrupted_s;
    if (transport.rank() != 0) {
      if (since_s > follows_s && transport.rank() == 1 && !transport.has_first_failed())
        throw LeaderLost("rank 0 has ended or does not answer, " + where);
      if (since_s > follows_s) throw std::runtime_error("the run has been ended");
      return;
    }
    const std::string missing = transport.missing(), who = missing.empty() ? "another rank" : missing;
    if (seconds < told_s) told_s = 0;  // another wait
    if (since_s > leads_s && seconds > leads_s)
      throw std::runtime_error(who + " has ended or does not answer, " + where);
    const std::string so_long = " has not answered for " + std::to_string(static_cast<long>(seconds)) + " s, " + where;
    if (limit_s > 0 && seconds > limit_s) throw std::runtime_error(who + so_long);
    if (seconds < first_told_s || seconds < 2 * told_s) return;
    std::fprintf(stderr, "waitpoint: %s%s\n", who.c_str(), so_long.c_str());
    told_s = seconds;
  };
}

}  // namespace waitpoint::tools
