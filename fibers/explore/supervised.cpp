// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/supervised.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>

#include "fibers/explore/process_ticks.hpp"

namespace waitpoint::exploration {
namespace {

// A schedule that takes longer is reported as long.
constexpr std::uint32_t long_s = 10;
constexpr int second_ms = 1000, patience_ms = 2000, fresh_ms_max = 10'000;
// An exit status that no body is likely to use.
constexpr int finished_status = 87;

class Watchman {
 public:
  Watchman(int pipe, Supervised& supervised, const Supervision& supervision)
      : pipe_(pipe), supervised_(supervised), supervision_(supervision) {}

  void run() {
    while (!is_over(second_ms)) look();
    if (!supervised_.done && supervised_.doing != Stage::nothing) tell("the process ended " + within());
  }

 private:
  bool is_over(int timeout_ms) {
    pollfd end{pipe_, POLLIN, 0};
    if (poll(&end, 1, timeout_ms) == 0) return false;
    char word = done_message;
    if (read(pipe_, &word, 1) != 1 || word != asks_for_fresh) return true;
    std::string token;
    while (read(pipe_, &word, 1) == 1 && word != '\n') token += word;
    run_fresh(token);
    return false;
  }

  // In a child of this process, which has never run the body.
  void run_fresh(const std::string& token) {
    const pid_t child = fork();
    if (child == 0) {
      const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
      for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, descriptor);
      supervised_.fresh_outcome = supervision_.run(read_token(token));
      _exit(finished_status);
    }
    int status = 0;
    for (int waited_ms = 0; child > 0 && waitpid(child, &status, WNOHANG) == 0; ++waited_ms) {
      if (waited_ms == fresh_ms_max) kill(child, SIGKILL);
      usleep(1000);
    }
    // Stored last: the next request may follow at once.
    const bool is_known = child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == finished_status;
    supervised_.fresh = is_known ? Fresh::known : Fresh::unknown;
  }

  // Once a second.
  void look() {
    const std::optional<std::uint64_t> ticks = ticks_of(supervision_.explored);
    const Stage doing = supervised_.doing;
    const bool is_one = doing == Stage::default_schedule || doing == Stage::schedule || doing == Stage::replay;
    const bool is_another = supervised_.turn != turn_ || !is_one;
    if (is_another) seconds_ = idle_s_ = 0;
    turn_ = supervised_.turn;
    if (is_another || !ticks) return;
    idle_s_ = *ticks == ticks_ ? idle_s_ + 1 : 0;
    ticks_ = *ticks;
    ++seconds_;
    if (idle_s_ >= idle_s_max)
      end(" was blocked for " + std::to_string(idle_s_) +
          " s by something that is not simulated, such as a real lock or input: process terminated");
    else if (supervision_.limit_s != 0 && seconds_ >= supervision_.limit_s)
      end(" exceeded the limit of " + std::to_string(seconds_) + " s: process terminated");
    else if (seconds_ == long_s && idle_s_ == 0)
      tell(which() + " has run for " + std::to_string(long_s) +
           " s; a task that loops without a simulated primitive never ends");
  }

  bool is_default() const { return supervised_.doing == Stage::default_schedule; }
  std::string which() const {
    if (supervised_.doing == Stage::replay) return "the replayed schedule";
    return is_default() ? "the default order" : "schedule " + std::to_string(supervised_.number);
  }
  std::string within() const {
    if (supervised_.doing != Stage::minimizing) return "within " + which();
    return "while the failure of " + which() +
           " was being minimised, in a run with fewer switches. The failure: " + supervised_.failure;
  }

  void tell(const std::string& words) const {
    Token token = supervision_.token;
    if (supervised_.doing != Stage::replay) token.number = supervised_.number;
    if (const char* const strategy = supervised_.strategy; strategy != nullptr) token.strategy = strategy;
    if (is_default()) token = {.call = token.call, .strategy = {}, .deviations = {}};
    const std::string text =
        "waitpoint: " + words + "\n" + supervision_.replay + to_text(token) + supervision_.after + "\n";
    (void)!write(STDERR_FILENO, text.data(), text.size());
  }

  [[noreturn]] void end(const std::string& why) {
    tell(which() + why);
    kill(supervision_.explored, end_signal);
    if (!is_over(patience_ms)) kill(supervision_.explored, SIGKILL);
    _exit(0);
  }

  int pipe_;
  Supervised& supervised_;
  const Supervision& supervision_;
  std::uint64_t turn_ = 0, ticks_ = 0;
  std::uint32_t seconds_ = 0, idle_s_ = 0;  // on the present turn; without CPU usage
};

}  // namespace

void supervise(int pipe, Supervised& supervised, const Supervision& supervision) {
  setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, SIG_IGN);
  Watchman(pipe, supervised, supervision).run();
  _exit(0);
}

}  // namespace waitpoint::exploration
