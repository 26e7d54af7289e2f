// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/misuse_log.hpp"

#include <algorithm>
#include <new>

#include "fibers/kernel/task.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/family/misuse.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/memory.hpp"
#include "fibers/posix/reports/program_calls.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t misuses_max = 100;

void log(const char* sentence) {
  const NewInFamily memory;
  void* const known = family::common(family::Part::misuses, 0);
  std::vector<LoggedMisuse>& all = static_cast<MisuseLog*>(known)->misuses;
  const auto is_same = [sentence](const LoggedMisuse& one) { return one.sentence == sentence; };
  if (all.size() == misuses_max || std::ranges::any_of(all, is_same)) return;
  all.push_back({sentence, kernel::running->local_time, running_calls()});
}

}  // namespace

void begin_misuse_log() {
  if (family::common(family::Part::misuses, 0) == nullptr) {
    void* const memory = family::common(family::Part::misuses, sizeof(MisuseLog));
    if (memory == nullptr) refuse("there is no memory for the misuses of this run");
    new (memory) MisuseLog();
  }
  on_misuse = log;
}

}  // namespace waitpoint::posix
