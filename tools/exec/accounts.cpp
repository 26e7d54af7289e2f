// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/accounts.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>

#include <vector>

#include "fibers/posix/signals/signals.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {
namespace {

using posix::family::Account;
using posix::family::Process;

constexpr int answer_ms_max = 500;

// The account of this process of the system; null if it does not answer.
const Account* ask(const posix::Record& record, pid_t process) {
  Account& account = family_of(record).account;
  account.is_written.store(false);
  sigval value{};
  value.sival_int = posix::question;
  if (process <= 0 || sigqueue(process, posix::bell, value) != 0) return nullptr;
  for (int waited_ms = 0; waited_ms < answer_ms_max; ++waited_ms) {
    if (account.is_written.load()) return &account;
    poll(nullptr, 0, 1);
  }
  return nullptr;
}

std::vector<std::string> places_in(const Account& account, std::size_t most) {
  sync::CodePlaces stack;
  for (int i = 0; i < account.place_count && i < Account::places_max; ++i)
    stack.push_back({account.places[i].module, account.places[i].offset, account.places[i].function});
  if (stack.empty()) return {};
  const sync::CodePlaces stacks[] = {stack};
  return sync::user_source_lines(stacks, most).front();
}

// The lines of one process.
std::string lines_of(const posix::Record& record, const Process& process) {
  if (process.is_native) return fmt::format("  process {} executes a program that is not simulated\n", process.id);
  if (process.state == Process::State::stopped) return fmt::format("  process {} is stopped\n", process.id);
  const Account* const account = ask(record, process.real_id);
  if (account == nullptr) return fmt::format("  process {} does not answer\n", process.id);
  std::string lines = account->states;
  constexpr std::size_t places_shown = 4;
  const bool has_turn = process_in_turn(record) == process.real_id;
  if (!has_turn || account->running[0] == '\0') return lines;
  std::string places;
  for (const std::string& place : places_in(*account, places_shown)) places += "      at " + place + "\n";
  const std::string computing = fmt::format("  {} computes\n", account->running);
  const std::size_t at = lines.find(computing);
  return at == std::string::npos ? lines : lines.insert(at + computing.size(), places);
}

}  // namespace

std::string states_of(const posix::Record& record) {
  if (!record.began) return "";
  std::string lines;
  for (const Process& process : entries_of(family_of(record)))
    if (process.state == Process::State::alive || process.state == Process::State::stopped)
      lines += lines_of(record, process);
  return lines;
}

Computing computing_thread(const posix::Record& record) {
  const Account* const account = record.began ? ask(record, process_in_turn(record)) : nullptr;
  if (account == nullptr) return {};
  const std::vector<std::string> places = places_in(*account, 1);
  return {account->running, places.empty() ? "" : places.front()};
}

}  // namespace waitpoint::tools
