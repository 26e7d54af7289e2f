// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/family/misuse.hpp"

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/family/task_names.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t sentence_max = 256;

void note(const char* does, const Waitable* what, const char* but, const kernel::Task* whom) {
  if (on_misuse == nullptr || !is_simulated()) return;
  const ErrorNumberKept kept;
  char room[sentence_max];
  BoundedText sentence(room, sizeof room);
  add_name(sentence, *kernel::running);
  sentence.add(" %s", does);
  if (what != nullptr) sentence.add(" ");
  if (what != nullptr) add_waitable(sentence, *what);
  sentence.add("%s", but);
  if (whom != nullptr) add_name(sentence, *whom);
  const InKernel within;  // what reports it is not simulated
  on_misuse(room);
}

}  // namespace

void (*on_misuse)(const char* sentence) = nullptr;

void note_misuse(const char* does, const Waitable& what, const char* but, const kernel::Task* whom) {
  note(does, &what, but, whom);
}

void note_misuse(const char* does) { note(does, nullptr, "", nullptr); }

}  // namespace waitpoint::posix
