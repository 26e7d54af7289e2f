// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/end_requests.hpp"

#include <signal.h>

#include <atomic>
#include <cstdio>

#include "core/error.hpp"
#include "tools/command/signal_words.hpp"
#include "tools/exec/accounts.hpp"
#include "tools/exec/family_report.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {
namespace {

constexpr int ends[] = {SIGINT, SIGTERM, SIGHUP}, passed_on[] = {SIGUSR1, SIGUSR2};
// timeout(1) sends a signal to the process and to its group; a program that leaves its end to this process sends
// another.
constexpr double echo_s = 0.2, patience_s = 2;

std::atomic<pid_t> receiver = 0;
std::atomic<int> come = 0;  // the latest signal that was not looked at
std::atomic<bool> is_of_terminal = false;

void note(int signal, siginfo_t* information, void*) {
  come.store(signal);
  is_of_terminal.store(information->si_code > 0);
}
void pass_on(int signal, siginfo_t*, void*) { kill(receiver.load(), signal); }
// Signals of the terminal reach the program anyway.
void pass_on_if_sent(int signal, siginfo_t* information, void*) {
  if (information->si_code <= 0) kill(receiver.load(), signal);
}

void set_handler(int signal, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action {
  }, before{};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO;
  // nohup(1) keeps its effect.
  const bool is_ignored = sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
  if (signal != SIGHUP || !is_ignored) sigaction(signal, &action, nullptr);
}

}  // namespace

EndRequests::EndRequests(const posix::Record& record, pid_t program) : record_(record), program_(program) {
  WAITPOINT_CHECK(program > 0, "signals are passed on to no process");
  receiver.store(program);
  come.store(0);
  for (const int signal : ends) set_handler(signal, note);
  for (const int signal : passed_on) set_handler(signal, pass_on);
  set_handler(SIGQUIT, pass_on_if_sent);
}

EndRequests::~EndRequests() {
  for (const int signal : ends) ::signal(signal, SIG_DFL);
  for (const int signal : passed_on) ::signal(signal, SIG_DFL);
  ::signal(SIGQUIT, SIG_DFL);
}

bool EndRequests::look() {
  if (ended_by_ != 0) return true;
  const double now_s = wall_clock_s();
  if (const int signal = come.exchange(0); signal != 0) {
    const bool is_sent = !is_of_terminal.load();
    if (asked_by_ != 0 && now_s - asked_at_s_ <= echo_s) return false;
    if (asked_by_ != 0 || !record_.began || !is_caught(record_, signal)) {
      end(signal);
      return true;
    }
    if (is_sent) kill(program_, signal);
    // The purpose of a handler is unknown: an interactive program has one for the key, a server for its log.
    if (signal == SIGHUP || !is_sent) return false;
    asked_by_ = signal;
    asked_at_s_ = now_s;
  }
  if (asked_by_ != 0 && now_s - asked_at_s_ > patience_s) end(asked_by_);
  return ended_by_ != 0;
}

int EndRequests::too_late() { return come.exchange(0); }

void EndRequests::end(int signal) {
  ended_by_ = signal;
  end_at_once(record_, program_, "ended by " + signal_in_words(signal));
}

void end_at_once(const posix::Record& record, pid_t program, const std::string& reason) {
  if (record.began)
    std::fprintf(stderr, "waitpoint: %s at %s s of virtual time\n%s", reason.c_str(),
                 to_string(time_of(record)).c_str(), states_of(record).c_str());
  kill_all(record);
  kill(program, SIGKILL);
}

}  // namespace waitpoint::tools
