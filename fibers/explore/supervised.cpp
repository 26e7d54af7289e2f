// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/supervised.hpp"

#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <optional>

namespace waitpoint::exploration {
namespace {

// After so many seconds a schedule is told to go on for long; one in which nothing is computed for as long waits for
// what nobody will give.
constexpr std::uint32_t long_s = 10;
constexpr int second_ms = 1000, patience_ms = 2000;

// The time that a process has computed, in the system's ticks; nothing where it is stopped, by a debugger for example.
std::optional<std::uint64_t> ticks_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text, ')');  // the number and the name, which may have blanks
  char state = 0;
  file >> state;
  constexpr int fields_between = 10;
  for (int i = 0; i < fields_between; ++i) file >> text;
  std::uint64_t user = 0, system = 0;
  if (!(file >> user >> system) || state == 'T' || state == 't') return std::nullopt;
  return user + system;
}

class Watchman {
 public:
  Watchman(int pipe, const Supervised& supervised, const Supervision& supervision)
      : pipe_(pipe), supervised_(supervised), supervision_(supervision) {}

  void run() {
    while (!is_over(second_ms)) look();
    if (!supervised_.done && supervised_.doing != Doing::nothing) tell("the process ended " + within());
  }

 private:
  bool is_over(int timeout_ms) const {
    pollfd end{pipe_, POLLIN, 0};
    return poll(&end, 1, timeout_ms) != 0;
  }

  // Once a second.
  void look() {
    const std::optional<std::uint64_t> ticks = ticks_of(supervision_.explored);
    const Doing doing = supervised_.doing;
    const bool is_another = supervised_.turn != turn_ || (doing != Doing::default_schedule && doing != Doing::schedule);
    if (is_another) seconds_ = idle_s_ = 0;
    turn_ = supervised_.turn;
    if (is_another || !ticks) return;
    idle_s_ = *ticks == ticks_ ? idle_s_ + 1 : 0;
    ticks_ = *ticks;
    ++seconds_;
    if (idle_s_ >= long_s)
      end(" has waited for " + std::to_string(idle_s_) +
          " s for something that is not simulated, a real lock or input: the process is ended");
    else if (supervision_.limit_s != 0 && seconds_ >= supervision_.limit_s)
      end(" has gone on for " + std::to_string(seconds_) + " s, the most that one may: the process is ended");
    else if (seconds_ == long_s && idle_s_ == 0)
      tell(which() + " has gone on for " + std::to_string(long_s) +
           " s; where a task loops without any simulated primitive, it will for ever");
  }

  bool is_default() const { return supervised_.doing == Doing::default_schedule; }
  std::string which() const {
    return is_default() ? "the default schedule" : "schedule " + std::to_string(supervised_.number);
  }
  std::string within() const {
    if (supervised_.doing != Doing::minimizing) return "within " + which();
    return "while the failure of " + which() +
           " was cut down, by a run of it with fewer switches. It had failed: " + supervised_.failure;
  }

  void tell(const std::string& words) const {
    Token token = supervision_.token;
    token.number = supervised_.number;
    if (is_default()) token.strategy.clear();
    const std::string text =
        "waitpoint: " + words + "\n" + supervision_.replay + to_text(token) + supervision_.after + "\n";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }

  [[noreturn]] void end(const std::string& why) const {
    tell(which() + why);
    kill(supervision_.explored, end_signal);
    if (!is_over(patience_ms)) kill(supervision_.explored, SIGKILL);
    _exit(0);
  }

  int pipe_;
  const Supervised& supervised_;
  const Supervision& supervision_;
  std::uint64_t turn_ = 0, ticks_ = 0;
  std::uint32_t seconds_ = 0, idle_s_ = 0;  // of this turn; without computing
};

}  // namespace

void supervise(int pipe, const Supervised& supervised, const Supervision& supervision) {
  setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  Watchman(pipe, supervised, supervision).run();
  _exit(0);
}

}  // namespace waitpoint::exploration
