// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/robot_program.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <sstream>

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

bool has_programs(const scenario::Scenario& scenario, bool are_commands) {
  for (const scenario::RobotScenario& robot : scenario.robots)
    for (const scenario::ProgramScenario& program : robot.programs)
      if (program.command.empty() != are_commands) return true;
  return false;
}

// As execvp() finds it.
bool is_executable(const std::string& name) {
  if (name.find('/') != std::string::npos) return access(name.c_str(), X_OK) == 0;
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder.append("/") + name).c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

bool has_shared_objects(const scenario::Scenario& scenario) { return has_programs(scenario, false); }
bool has_commands(const scenario::Scenario& scenario) { return has_programs(scenario, true); }

bool can_load_programs() { return guests() != nullptr; }

void RobotPrograms::set_network(io::Network& network) {
  carrier_ = {&network, carry<&io::Link::send_datagram>, carry<&io::Link::send_in_order>};
  if (can_load_programs()) guests()->set_carrier(&carrier_);
}

void RobotPrograms::start(const scenario::ProgramScenario& program, kernel::Robot& robot) {
  const char* const library = std::getenv(library_variable);
  if (library == nullptr) throw program.written.bad("expected no command: only the program `waitpoint` can start it");
  if (!is_executable(program.command.front()))
    throw program.written.bad("there is no program '" + program.command.front() + "'");
  if (commands_ == nullptr) commands_ = std::make_unique<posix::HostedFamily>(scheduler_, library);
  const int number = commands_->has_memory() ? commands_->start(program.name, program.command, robot) : -1;
  if (number < 0) throw program.written.bad("the system makes no process for program '" + program.name + "'");
  programs_.push_back({nullptr, number, &robot});
}

void RobotPrograms::add(const scenario::ProgramScenario& program, kernel::Robot& robot) {
  for (const Loaded& other : programs_)
    if ((other.guest == nullptr) != !program.command.empty())
      throw program.written.bad("expected programs of one kind in a scenario, shared objects or commands, got both");
  if (!program.command.empty()) return start(program, robot);
  if (!can_load_programs())
    throw program.written.bad("expected no programs: only the program `waitpoint` can load them");
  std::vector<const char*> words{program.file.c_str()};
  for (const std::string& argument : program.arguments) words.push_back(argument.c_str());
  posix::Guests::Error error;
  posix::Guest* const guest = guests()->load(program.name.c_str(), static_cast<int>(words.size()), words.data(), error);
  if (guest == nullptr) throw program.written.bad(error);
  programs_.push_back({guest, 0, &robot});
  scheduler_.hooks().deliver_signals = deliver_signals;
  if (!guests()->start(*guest, scheduler_, robot))
    throw program.written.bad("not enough memory for the thread of program '" + program.name + "'");
}

void RobotPrograms::take_away() {
  if (carrier_.network != nullptr && can_load_programs()) guests()->set_carrier(nullptr);
  carrier_ = {};
  if (programs_.empty()) return;
  const bool are_guests = commands_ == nullptr;
  if (are_guests)
    for (const Loaded& program : programs_) guests()->take_away(program.guest, scheduler_);
  programs_.clear();
  if (are_guests) guests()->forget_names();
  commands_.reset();
}

std::vector<std::optional<int>> RobotPrograms::exit_statuses(const kernel::Robot& robot) const {
  std::vector<std::optional<int>> statuses;
  for (const Loaded& program : programs_) {
    if (program.robot != &robot) continue;
    int status = 0;
    if (program.guest == nullptr)
      statuses.push_back(commands_->exit_status(program.number));
    else
      statuses.push_back(guests()->has_ended(*program.guest, status) ? std::optional(status) : std::nullopt);
  }
  return statuses;
}

}  // namespace waitpoint::run
