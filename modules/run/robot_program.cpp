// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/robot_program.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <utility>

#include "core/program_path.hpp"
#include "fibers/sync/signals.hpp"

namespace waitpoint::run {
namespace {

const posix::Guests* guests() { return static_cast<const posix::Guests*>(dlsym(RTLD_DEFAULT, posix::Guests::symbol)); }

void deliver_signals(kernel::Task& task) {
  guests()->is_guest(task) ? guests()->deliver_signals(task) : sync::deliver_signals(task);
}

template <bool in_order>
bool carry(void* network, const kernel::Robot& from, const void* to, std::size_t bytes, void (*arrive)(void*),
           void (*drop)(void*), void* message) {
  const std::shared_ptr<io::Node> node = static_cast<io::Network*>(network)->node(from.name);
  io::Link* const link = node != nullptr ? node->link_to(static_cast<const kernel::Robot*>(to)->name) : nullptr;
  if (link == nullptr) return false;
  io::Parcels& parcels = node->parcels();
  const io::Packet packet{.kind = io::PacketKind::parcel, .number = parcels.keep(message, arrive, drop)};
  if constexpr (in_order)
    link->send_in_order(bytes, packet);
  else if (!link->send_datagram(bytes, packet))
    parcels.drop(packet.number);
  return true;
}

// Looks for conditions of starts come before all tasks of their instant.
constexpr Duration between_looks = std::chrono::milliseconds(1);
constexpr std::uint64_t order_of_looks = kernel::make_order(kernel::Phase::deliveries, kernel::tie_mask);

bool has_programs(const scenario::Scenario& scenario, bool are_commands) {
  for (const scenario::RobotScenario& robot : scenario.robots)
    for (const scenario::ProgramScenario& program : robot.programs)
      if (program.command.empty() != are_commands) return true;
  return false;
}

}  // namespace

bool has_shared_objects(const scenario::Scenario& scenario) { return has_programs(scenario, false); }
bool has_commands(const scenario::Scenario& scenario) { return has_programs(scenario, true); }

bool can_load_programs() { return guests() != nullptr; }

void RobotPrograms::set_network(io::Network& network) {
  carrier_ = {.network = &network, .carry = carry<false>, .carry_in_order = carry<true>};
  if (can_load_programs()) guests()->set_carrier(&carrier_);
}

void RobotPrograms::load(Loaded& loaded) {
  const scenario::ProgramScenario& program = loaded.program;
  if (!program.command.empty()) {
    const char* const library = std::getenv(library_variable);
    if (library == nullptr) throw program.written.bad("expected no command: only the program `waitpoint` can start it");
    if (find_program(program.command.front()).empty())
      throw program.written.bad("there is no program '" + program.command.front() + "'");
    if (commands_ == nullptr) commands_ = std::make_unique<posix::HostedFamily>(scheduler_, library);
    return;
  }
  if (!can_load_programs())
    throw program.written.bad("expected no programs: only the program `waitpoint` can load them");
  std::vector<const char*> words{program.file.c_str()};
  for (const std::string& argument : program.arguments) words.push_back(argument.c_str());
  posix::Guests::Error error;
  loaded.guest = guests()->load(program.name.c_str(), static_cast<int>(words.size()), words.data(), error);
  if (loaded.guest == nullptr) throw program.written.bad(error);
  scheduler_.hooks().deliver_signals = deliver_signals;
}

void RobotPrograms::start(Loaded& loaded) {
  const scenario::ProgramScenario& program = loaded.program;
  loaded.has_started = true;
  if (loaded.guest == nullptr) {
    if (commands_->has_memory()) loaded.number = commands_->start(program.name, program.command, *loaded.robot);
    if (loaded.number < 0) throw program.written.bad("the system makes no process for program '" + program.name + "'");
  } else if (!guests()->start(*loaded.guest, scheduler_, *loaded.robot)) {
    throw program.written.bad("not enough memory for the thread of program '" + program.name + "'");
  }
}

void RobotPrograms::add(const scenario::ProgramScenario& program, kernel::Robot& robot) {
  for (const Loaded& other : programs_)
    if (other.program.command.empty() != program.command.empty())
      throw program.written.bad("expected programs of one kind in a scenario, shared objects or commands, got both");
  load(programs_.emplace_back(Loaded{program, &robot}));
  if (program.after.empty()) return start(programs_.back());
  look_.node.fire = look;
  look_.programs = this;
  if (!look_.node.in_list()) scheduler_.schedule(look_.node, {scheduler_.global_time(), order_of_looks});
}

void RobotPrograms::look(kernel::EventNode& node) { reinterpret_cast<Look&>(node).programs->start_those_due(); }

void RobotPrograms::start_those_due() {
  bool any_waits = false;
  for (Loaded& loaded : programs_) {
    if (loaded.has_started) continue;
    const bool is_due = std::all_of(loaded.program.after.begin(), loaded.program.after.end(),
                                    [&](const StartCondition& each) { return holds(each, *loaded.robot); });
    any_waits = any_waits || !is_due;
    if (!is_due) continue;
    // The start is no action of the task whose event was the last.
    kernel::Task* const task = std::exchange(kernel::running, nullptr);
    start(loaded);
    kernel::running = task;
  }
  if (any_waits) scheduler_.schedule(look_.node, {scheduler_.global_time() + between_looks, order_of_looks});
}

bool RobotPrograms::holds(const StartCondition& condition, const kernel::Robot& robot) const {
  if (!condition.is_of_program()) return holds_outside(condition);
  const auto other = std::find_if(programs_.begin(), programs_.end(), [&](const Loaded& each) {
    return each.robot == &robot && each.program.name == condition.of;
  });
  if (other == programs_.end() || !other->has_started) return false;
  return condition.kind == StartCondition::Kind::start || exit_status(*other).has_value();
}

void RobotPrograms::take_away() {
  if (carrier_.network != nullptr && can_load_programs()) guests()->set_carrier(nullptr);
  carrier_ = {};
  if (programs_.empty()) return;
  if (look_.node.in_list()) scheduler_.cancel(look_.node);
  const bool are_guests = commands_ == nullptr;
  if (are_guests)
    for (const Loaded& program : programs_)
      if (program.guest != nullptr) guests()->take_away(program.guest, scheduler_);
  programs_.clear();
  if (are_guests && can_load_programs()) guests()->forget_names();
  commands_.reset();
}

std::optional<int> RobotPrograms::exit_status(const Loaded& program) const {
  if (!program.has_started) return std::nullopt;
  if (program.guest == nullptr) return commands_->exit_status(program.number);
  int status = 0;
  return guests()->has_ended(*program.guest, status) ? std::optional(status) : std::nullopt;
}

std::vector<std::optional<int>> RobotPrograms::exit_statuses(const kernel::Robot& robot) const {
  std::vector<std::optional<int>> statuses;
  for (const Loaded& program : programs_)
    if (program.robot == &robot) statuses.push_back(exit_status(program));
  return statuses;
}

}  // namespace waitpoint::run
