// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/host/in_process_host.hpp"

#include <dlfcn.h>

#include "fibers/kernel/run.hpp"
#include "fibers/posix/host/robot_of.hpp"
#include "fibers/sync/signals.hpp"

namespace waitpoint::posix {
namespace {

// Null without the library.
const InProcessLayer* layer() {
  return static_cast<const InProcessLayer*>(dlsym(RTLD_DEFAULT, InProcessLayer::symbol));
}

void deliver_signals_of(kernel::Task& task) {
  layer()->is_program_task(task) ? layer()->deliver_signals(task) : sync::deliver_signals(task);
}

}  // namespace

bool InProcessHost::is_possible() { return layer() != nullptr; }

InProcessHost::~InProcessHost() {
  if (!is_possible()) return;
  layer()->set_carrier(nullptr);
  for (const Program& program : programs_) layer()->drop(program.loaded, scheduler_);
  layer()->forget_names();
}

void InProcessHost::set_carrier(const Carrier& carrier) {
  if (is_possible()) layer()->set_carrier(&carrier);
}

void InProcessHost::add(const HostedProgram& program) {
  if (!is_possible()) throw HostingError("expected no programs: only the program `waitpoint` can load them");
  std::vector<const char*> words;
  words.reserve(program.words.size());
  for (const std::string& word : program.words) words.push_back(word.c_str());
  InProcessLayer::Error error;
  LoadedProgram* const loaded =
      layer()->load(program.name.c_str(), static_cast<int>(words.size()), words.data(), error);
  if (loaded == nullptr) throw HostingError(error);
  programs_.push_back({loaded, &robot_of(scheduler_, program), program.name});
  kernel::hooks(scheduler_).deliver_signals = deliver_signals_of;
}

void InProcessHost::start(std::size_t program) {
  const Program& started = programs_[program];
  if (!layer()->start(*started.loaded, scheduler_, *started.robot))
    throw HostingError("not enough memory for the thread of program '" + started.name + "'");
}

std::optional<ProgramEnd> InProcessHost::end_of(std::size_t program) const {
  int status = 0;
  return layer()->has_ended(*programs_[program].loaded, status) ? std::optional(ProgramEnd(status)) : std::nullopt;
}

}  // namespace waitpoint::posix
