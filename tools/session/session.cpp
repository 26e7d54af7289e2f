// SPDX-License-Identifier: BSD-3-Clause
//
// waitpoint-session: the first process of `waitpoint exec -- A :: B :: C`, an ordinary program in the simulation. It
// starts the programs, each as a process of its own, when their conditions hold, and waits for their ends.
//
//   waitpoint-session [--quiet] NAME PLACE [after:CONDITION ...] -- FILE ARGUMENTS :: NAME PLACE ...
//
// PLACE is the program's number on the command line. The exit status is that of the first on the command line that has
// another than 0, as a shell reports it.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/start_condition.hpp"

namespace waitpoint::session {
namespace {

constexpr std::size_t told_apart_max = 20;  // limit of programs whose exit statuses are listed one by one
constexpr std::chrono::milliseconds between_looks{1};

struct Program {
  std::string name;
  int place = 0;
  std::vector<StartCondition> conditions;
  std::vector<char*> words;  // ends with null
  pid_t process = 0;         // 0: not started yet
  bool has_ended = false;
  int status = 0;
};

// The words are those that `waitpoint exec` has checked and composed.
std::vector<Program> programs_of(char** words) {
  constexpr std::string_view after = "after:";
  std::vector<Program> programs;
  while (*words != nullptr) {
    Program& program = programs.emplace_back();
    program.name = *words++;
    program.place = std::atoi(*words++);
    for (; std::strcmp(*words, "--") != 0; ++words) parse(*words + after.size(), program.conditions.emplace_back());
    for (++words; *words != nullptr && std::strcmp(*words, "::") != 0; ++words) program.words.push_back(*words);
    program.words.push_back(nullptr);
    if (*words != nullptr) ++words;
  }
  return programs;
}

class Session {
 public:
  explicit Session(std::vector<Program> programs) : programs_(std::move(programs)) {}

  void run() {
    while (start_those_due(), !have_all_ended()) {
      const bool looks = waits_for_outside();
      const bool has_ended = note_end(looks ? WNOHANG : 0);
      if (!looks || has_ended) continue;
      tell_who_waits_alone();
      std::this_thread::sleep_for(between_looks);
    }
  }

  int status() const {
    const Program* failed = nullptr;
    for (const Program& program : programs_)
      if (program.status != 0 && (failed == nullptr || program.place < failed->place)) failed = &program;
    return failed == nullptr ? 0 : failed->status;
  }

  /// "exit status: filter 0, reader 5", or, of many, a number and those that failed.
  std::string ends() const {
    const bool are_told_apart = programs_.size() <= told_apart_max;
    std::string text;
    std::size_t good = 0;
    for (const Program& program : programs_) {
      if (program.status == 0) ++good;
      if (program.status == 0 && !are_told_apart) continue;
      text += text.empty() ? "" : ", ";
      text += program.name;
      text += ' ';
      text += std::to_string(program.status);
    }
    if (are_told_apart) return text;
    std::string all = good == programs_.size() ? "0 of all " : "0 of ";
    all += std::to_string(good);
    if (!text.empty()) all += ", ";
    return all + text;
  }

 private:
  bool holds(const StartCondition& condition) const {
    if (!condition.is_of_program()) return holds_outside(condition);
    const auto other = std::find_if(programs_.begin(), programs_.end(),
                                    [&condition](const Program& each) { return each.name == condition.of; });
    if (other == programs_.end()) return true;
    return condition.kind == StartCondition::Kind::end ? other->has_ended : other->process != 0;
  }

  // A start may be another program's condition.
  void start_those_due() {
    for (bool any = true; any;) {
      any = false;
      for (Program& program : programs_) {
        const auto& conditions = program.conditions;
        if (program.process != 0 || !std::all_of(conditions.begin(), conditions.end(),
                                                 [this](const StartCondition& each) { return holds(each); }))
          continue;
        start(program);
        any = true;
      }
    }
  }

  static void start(Program& program) {
    setenv("WAITPOINT_NAME", program.name.c_str(), 1);
    const int error = posix_spawnp(&program.process, program.words[0], nullptr, nullptr, program.words.data(), environ);
    unsetenv("WAITPOINT_NAME");
    if (error == 0) return;
    std::fprintf(stderr, "waitpoint: exec: %s cannot be started: %s\n", program.words[0], std::strerror(error));
    program.process = -1;
    program.has_ended = true;
    program.status = 127;
  }

  bool have_all_ended() const {
    return std::all_of(programs_.begin(), programs_.end(), [](const Program& each) { return each.has_ended; });
  }

  bool waits_for_outside() const {
    return std::any_of(programs_.begin(), programs_.end(), [](const Program& each) {
      return each.process == 0 && std::any_of(each.conditions.begin(), each.conditions.end(),
                                              [](const StartCondition& one) { return !one.is_of_program(); });
    });
  }

  // Once: what an ended program has left behind may still fulfil a condition.
  void tell_who_waits_alone() {
    const auto runs = [](const Program& each) { return each.process != 0 && !each.has_ended; };
    if (has_told_ || std::any_of(programs_.begin(), programs_.end(), runs)) return;
    has_told_ = true;
    for (const Program& program : programs_)
      for (const StartCondition& each : program.conditions)
        if (program.process == 0 && !holds(each))
          std::fprintf(stderr, "waitpoint: %s waits for its start, after:%s, and no program is running\n",
                       program.name.c_str(), in_words(each).c_str());
  }

  static std::string in_words(const StartCondition& condition) {
    if (condition.kind == StartCondition::Kind::port) return "tcp:" + std::to_string(condition.port);
    return condition.kind == StartCondition::Kind::start ? condition.of + ".started" : condition.of;
  }

  bool note_end(int flags) {
    int status = 0;
    const pid_t process = waitpid(-1, &status, flags);
    for (Program& program : programs_) {
      if (process <= 0 || program.process != process) continue;
      program.has_ended = true;
      program.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      if (!WIFEXITED(status))
        std::fprintf(stderr, "waitpoint: %s was terminated by signal %d (%s)\n", program.name.c_str(), WTERMSIG(status),
                     strsignal(WTERMSIG(status)));
    }
    return process > 0;
  }

  std::vector<Program> programs_;
  bool has_told_ = false;  // that none is running
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
