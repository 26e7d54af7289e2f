// SPDX-License-Identifier: BSD-3-Clause
//
// waitpoint-session: the first process of `waitpoint exec -- A :: B :: C`, an ordinary program in the simulation. It
// starts the programs, each as a process of its own, when their conditions hold, and waits for their ends.
//
//   waitpoint-session [--quiet] NAME PLACE [after:CONDITION ...] -- FILE ARGUMENTS :: NAME PLACE ...
//
// PLACE is the program's number on the command line. The exit status is that of the first on the command line that has
// another than 0, as a shell reports it.
#include <sys/wait.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/hosting/hosted_programs.hpp"
#include "core/hosting/spawned_processes.hpp"

namespace waitpoint::session {
namespace {

constexpr std::size_t listed_one_by_one_max = 20;  // programs whose exit statuses are
constexpr std::chrono::milliseconds between_looks{1};

struct Program {
  HostedProgram hosted;
  int place = 0;
};

// The words are those that `waitpoint exec` has checked and composed.
std::vector<Program> programs_of(char** words) {
  constexpr std::string_view after = "after:";
  std::vector<Program> programs;
  while (*words != nullptr) {
    Program& program = programs.emplace_back();
    HostedProgram& hosted = program.hosted;
    hosted.name = *words++;
    hosted.has_input = true;
    hosted.environment = {{"WAITPOINT_NAME", hosted.name}};
    program.place = std::atoi(*words++);
    for (; std::strcmp(*words, "--") != 0; ++words) parse(*words + after.size(), hosted.after.emplace_back());
    for (++words; *words != nullptr && std::strcmp(*words, "::") != 0; ++words) hosted.words.emplace_back(*words);
    if (*words != nullptr) ++words;
  }
  return programs;
}

class Session {
 public:
  explicit Session(const std::vector<Program>& programs) {
    for (const Program& program : programs) {
      programs_.add(program.hosted);
      places_.push_back(program.place);
    }
    reported_.resize(programs.size());
  }

  void run() {
    while (start_those_due(), !programs_.have_all_ended()) {
      const bool looks = programs_.waits_for_outside();
      const bool has_ended = processes_.await_end(looks ? WNOHANG : 0);
      report_signals();
      if (!looks || has_ended) continue;
      report_lone_waits();
      std::this_thread::sleep_for(between_looks);
    }
  }

  int status() const {
    std::size_t failed = programs_.size();
    for (std::size_t i = 0; i < programs_.size(); ++i)
      if (status_of(i) != 0 && (failed == programs_.size() || places_[i] < places_[failed])) failed = i;
    return failed == programs_.size() ? 0 : status_of(failed);
  }

  /// "exit status: filter 0, reader 5", or, of many, a number and those that failed.
  std::string ends() const {
    const bool are_listed = programs_.size() <= listed_one_by_one_max;
    std::string text;
    std::size_t good = 0;
    for (std::size_t i = 0; i < programs_.size(); ++i) {
      if (status_of(i) == 0) ++good;
      if (status_of(i) == 0 && !are_listed) continue;
      text += text.empty() ? "" : ", ";
      text += programs_.program(i).name + " " + std::to_string(status_of(i));
    }
    if (are_listed) return text;
    std::string all = good == programs_.size() ? "0 of all " : "0 of ";
    all += std::to_string(good);
    if (!text.empty()) all += ", ";
    return all + text;
  }

 private:
  void start_those_due() {
    for (bool are_started = false; !are_started;) {
      try {
        programs_.start_those_due();
        are_started = true;
      } catch (const HostingError& error) {
        std::fprintf(stderr, "waitpoint: exec: %s\n", error.what());
      }
    }
  }

  int status_of(std::size_t program) const {
    const std::optional<ProgramEnd> end = programs_.end_of(program);
    return end ? end->exit_status() : 0;
  }

  void report_signals() {
    for (std::size_t i = 0; i < programs_.size(); ++i) {
      const std::optional<ProgramEnd> end = programs_.end_of(i);
      if (!end || end->signal() == 0 || reported_[i]) continue;
      reported_[i] = true;
      std::fprintf(stderr, "waitpoint: %s was terminated by signal %d (%s)\n", programs_.program(i).name.c_str(),
                   end->signal(), strsignal(end->signal()));
    }
  }

  // Once: what an ended program has left behind may still fulfil a condition.
  void report_lone_waits() {
    for (std::size_t i = 0; i < programs_.size(); ++i)
      if (has_reported_waits_ || programs_.runs(i)) return;
    has_reported_waits_ = true;
    for (std::size_t i = 0; i < programs_.size(); ++i)
      if (const StartCondition* const awaited = programs_.awaited_by(i);
          !programs_.has_started(i) && awaited != nullptr)
        std::fprintf(stderr, "waitpoint: %s waits for its start, after:%s, and no program is running\n",
                     programs_.program(i).name.c_str(), in_words(*awaited).c_str());
  }

  SpawnedProcesses processes_;
  HostedPrograms programs_{processes_};
  std::vector<int> places_;
  std::vector<bool> reported_;  // ends by signals
  bool has_reported_waits_ = false;
};

}  // namespace
}  // namespace waitpoint::session

int main(int argc, char** argv) {
  using namespace waitpoint::session;
  const bool is_quiet = argc > 1 && std::strcmp(argv[1], "--quiet") == 0;
  Session session(programs_of(argv + (is_quiet ? 2 : 1)));
  session.run();
  std::fflush(stdout);
  if (!is_quiet || session.status() != 0) std::fprintf(stderr, "waitpoint: exit status: %s\n", session.ends().c_str());
  return session.status();
}
