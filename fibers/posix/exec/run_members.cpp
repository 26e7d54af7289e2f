// SPDX-License-Identifier: BSD-3-Clause
//
// A process that consists of several programs.
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/exec/run.hpp"
#include "fibers/posix/members/members.hpp"

namespace waitpoint::posix {
namespace {

constexpr char separator[] = "::";

// 0 if all programs have status 0, else the status of the first on the command line that has another.
int status_of_all(const Record& all) {
  const ProgramRecord* failed = nullptr;
  for (const ProgramRecord& one : all.several())
    if (one.status != 0 && (failed == nullptr || one.place < failed->place)) failed = &one;
  return failed == nullptr ? 0 : failed->status;
}

// The number of words of one program, up to the next separator.
int count_words(char** words) {
  int count = 0;
  while (words[count] != nullptr && std::strcmp(words[count], separator) != 0) ++count;
  return count;
}

}  // namespace

// The programs are loaded before the run: exploration forks many runs from here.
void run_members(int argc, char** argv) {
  const std::uint32_t count = record->program_count;
  auto* const members = static_cast<Member*>(std::calloc(count, sizeof(Member)));
  if (members == nullptr) refuse("there is no memory for the programs");
  char** words = argv + 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    Member& member = *new (members + i) Member();
    WAITPOINT_CHECK(words - argv <= argc, "the command line has fewer programs than the record");
    member.argc = count_words(words);
    member.argv = words;
    words += member.argc + 1;
    if (words - argv <= argc) words[-1] = nullptr;
    LoadError error;
    if (!load(member.image, member.argv[0], error)) refuse(error);
  }
  kernel::Scheduler& scheduler = begin_run();
  for (std::uint32_t i = 0; i < count; ++i) {
    Member& member = members[i];
    member.record = record->programs + i;
    member.robot = &member.record->robot;
    scheduler.add(member.record->robot, member.record->name);
    if (!start(member, scheduler)) refuse("there is no address space for the stacks of threads");
  }
  run_to_end(scheduler);
  end_run(scheduler, status_of_all(*record));
}

}  // namespace waitpoint::posix
