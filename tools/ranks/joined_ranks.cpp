// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ranks/joined_ranks.hpp"

#include <dlfcn.h>

#include <cstdio>
#include <stdexcept>

#include "core/error.hpp"
#include "core/missing_part.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "tools/command/installed_part.hpp"
#include "tools/command/interruption.hpp"
#include "tools/output/progress.hpp"
#include "tools/ranks/launcher.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* library = "libwaitpoint-mpi.so";

std::string library_path() {
  try {
    return find_part(library).string();
  } catch (const BadInput&) {
    throw BadInput("--ranks", std::string("ranks are not in this program: ") + missing_part::ranks);
  }
}

/// The time since the interruption of this process, which may be mpirun's: where one ends badly on another host it
/// interrupts all others.
class Interrupted {
 public:
  double seconds() {
    const double now_s = wall_clock_s();
    if (interruption() == 0) begin_s_ = now_s;
    return now_s - begin_s_;
  }

 private:
  double begin_s_ = 0;
};

// An ended process may have sent the awaited message.
constexpr double arrives_s = 0.15;

/// Tells of one that has not answered for 5, 10, 20, ... seconds.
class Reminder {
 public:
  void tell(const std::string& who, double seconds, const std::string& where) {
    constexpr double first_s = 5;
    if (seconds < reported_s_) reported_s_ = 0;  // another wait
    if (seconds < first_s || seconds < 2 * reported_s_) return;
    std::fprintf(stderr, "waitpoint: %s\n", text(who, seconds, where).c_str());
    reported_s_ = seconds;
  }
  static std::string text(const std::string& who, double seconds, const std::string& where) {
    return who + " has not answered for " + std::to_string(static_cast<long>(seconds)) + " s, " + where;
  }

 private:
  double reported_s_ = 0;
};

run::Ranks::Waiting watch_followers(run::Transport& transport, const RankProcesses& processes, double limit_s) {
  return [&transport, &processes, limit_s, interrupted = Interrupted(), reminder = Reminder()](
             double seconds, const std::string& where) mutable {
    // The user interrupts the first rank alone, which then ends all in order.
    constexpr double in_order_s = 0.4;
    const std::string ended = processes.ended();
    if (!ended.empty() && seconds > arrives_s) throw std::runtime_error(ended + " has ended, " + where);
    const std::string missing = transport.missing(), who = missing.empty() ? "another rank" : missing;
    if (interrupted.seconds() > in_order_s && seconds > in_order_s)
      throw std::runtime_error(who + " has ended or does not answer, " + where);
    if (limit_s > 0 && seconds > limit_s) throw std::runtime_error(Reminder::text(who, seconds, where));
    reminder.tell(who, seconds, where);
  };
}

// The leader may take its time, at the prompt.
run::Ranks::Waiting watch_leader(run::Transport& transport, const RankProcesses& processes, double limit_s) {
  return [&transport, &processes, limit_s, interrupted = Interrupted(), reminder = Reminder()](
             double seconds, const std::string& where) mutable {
    constexpr double in_order_s = 0.9;
    const std::string who = "rank 0";
    const bool has_ended = processes.has_ended(0) && seconds > arrives_s, is_stopped = processes.is_stopped(0);
    const bool is_lost = is_stopped && limit_s > 0 && seconds > limit_s;
    int first_left = 1;
    while (first_left < transport.rank() && processes.has_ended(first_left)) ++first_left;
    const bool is_reporter = transport.rank() == first_left;
    if (is_stopped && is_reporter) reminder.tell(who, seconds, where);
    if (!has_ended && !is_lost && interrupted.seconds() <= in_order_s) return;
    if (!is_reporter || transport.has_first_failed()) throw std::runtime_error("the run has been ended");
    throw LeaderLost(is_lost ? Reminder::text(who, seconds, where)
                             : who + (has_ended ? " has ended, " : " has ended or does not answer, ") + where);
  };
}

}  // namespace

void check_for_ranks() { (void)library_path(); }

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

run::Ranks::Waiting watch_over(run::Transport& transport, const RankProcesses& processes, double limit_s) {
  return transport.rank() == 0 ? watch_followers(transport, processes, limit_s)
                               : watch_leader(transport, processes, limit_s);
}

}  // namespace waitpoint::tools
