// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/robot_program.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <memory>

#include "fibers/sync/signals.hpp"

namespace waitpoint::run {
namespace {

const posix::Guests* guests() { return static_cast<const posix::Guests*>(dlsym(RTLD_DEFAULT, posix::Guests::symbol)); }

void deliver_signals(kernel::Task& task) {
  guests()->is_guest(task) ? guests()->deliver_signals(task) : sync::deliver_signals(task);
}

template <void (io::Link::*send)(std::size_t bytes, io::Link::Arrival arrival)>
bool carry(void* network, const kernel::Robot& from, const kernel::Robot& to, std::size_t bytes, void (*arrive)(void*),
           void (*drop)(void*), void* message) {
  const std::shared_ptr<io::Node> node = static_cast<io::Network*>(network)->node(from.name);
  io::Link* const link = node != nullptr ? node->link_to(to.name) : nullptr;
  if (link == nullptr) return false;
  (link->*send)(bytes, [arrive, kept = std::shared_ptr<void>(message, drop)] { arrive(kept.get()); });
  return true;
}

}  // namespace

bool has_programs(const scenario::Scenario& scenario) {
  return std::any_of(scenario.robots.begin(), scenario.robots.end(),
                     [](const scenario::RobotScenario& robot) { return !robot.programs.empty(); });
}

bool can_load_programs() { return guests() != nullptr; }

void RobotPrograms::set_network(io::Network& network) {
  carrier_ = {&network, carry<&io::Link::send_datagram>, carry<&io::Link::send_in_order>};
  if (can_load_programs()) guests()->set_carrier(&carrier_);
}

void RobotPrograms::add(const scenario::ProgramScenario& program, kernel::Robot& robot) {
  if (!can_load_programs())
    throw program.written.bad("expected no programs: only the program `waitpoint` can load them");
  std::vector<const char*> words{program.file.c_str()};
  for (const std::string& argument : program.arguments) words.push_back(argument.c_str());
  posix::Guests::Error error;
  posix::Guest* const guest = guests()->load(program.name.c_str(), static_cast<int>(words.size()), words.data(), error);
  if (guest == nullptr) throw program.written.bad(error);
  programs_.push_back({guest, &robot});
  scheduler_.hooks().deliver_signals = deliver_signals;
  if (!guests()->start(*guest, scheduler_, robot))
    throw program.written.bad("not enough memory for the thread of program '" + program.name + "'");
}

void RobotPrograms::take_away() {
  if (carrier_.network != nullptr && can_load_programs()) guests()->set_carrier(nullptr);
  carrier_ = {};
  if (programs_.empty()) return;
  for (const Loaded& program : programs_) guests()->take_away(program.guest, scheduler_);
  programs_.clear();
  guests()->forget_names();
}

std::vector<std::optional<int>> RobotPrograms::exit_statuses(const kernel::Robot& robot) const {
  std::vector<std::optional<int>> statuses;
  for (const Loaded& program : programs_) {
    if (program.robot != &robot) continue;
    int status = 0;
    statuses.push_back(guests()->has_ended(*program.guest, status) ? std::optional(status) : std::nullopt);
  }
  return statuses;
}

}  // namespace waitpoint::run
