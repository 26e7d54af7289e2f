// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/robot_program.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "core/file_list.hpp"
#include "core/program_path.hpp"
#include "fibers/kernel/common_order.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/posix/host/in_process_host.hpp"
#include "fibers/posix/host/process_host.hpp"

namespace waitpoint::run {
namespace {

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

std::filesystem::path library_of_processes(const scenario::ProgramScenario& program) {
  const char* const library = std::getenv(library_variable);
  if (library == nullptr) throw program.written.bad("expected no command: only the program `waitpoint` can start it");
  return library;
}

HostedProgram hosted(const scenario::ProgramScenario& program, const kernel::Robot& robot) {
  const std::string& named = program.words.front();
  const std::filesystem::path file = program.is_shared_object ? std::filesystem::path(named) : find_program(named);
  if (!file.empty()) FileList::add(file, FileRole::executed);
  HostedProgram hosted{.name = program.name, .robot = robot.name, .words = program.words, .after = program.after};
  if (program.is_shared_object && program.hosting == Hosting::processes) {
    if (!std::filesystem::exists(program.words.front()))
      throw program.written.bad("there is no program '" + program.words.front() + "'");
    hosted.words.insert(hosted.words.begin(), library_of_processes(program).replace_filename(loader_file));
  }
  return hosted;
}

}  // namespace

bool has_programs(const scenario::Scenario& scenario, Hosting hosting) {
  const auto is_hosted_so = [hosting](const scenario::ProgramScenario& program) { return program.hosting == hosting; };
  return std::ranges::any_of(scenario.robots, [&](const scenario::RobotScenario& robot) {
    return std::ranges::any_of(robot.programs, is_hosted_so);
  });
}

void RobotPrograms::set_network(io::Network& network) {
  carrier_ = {.network = &network, .carry = carry<false>, .carry_in_order = carry<true>};
}

void RobotPrograms::make_host(const scenario::ProgramScenario& first) {
  if (first.hosting == Hosting::processes) {
    host_ = std::make_unique<posix::ProcessHost>(scheduler_, library_of_processes(first));
  } else {
    auto host = std::make_unique<posix::InProcessHost>(scheduler_);
    if (carrier_.network != nullptr) host->set_carrier(carrier_);
    host_ = std::move(host);
  }
  programs_.emplace(*host_);
}

void RobotPrograms::add(const scenario::ProgramScenario& program, const kernel::Robot& robot) {
  if (host_ == nullptr) make_host(program);
  for (const scenario::ProgramScenario& other : scenarios_)
    if (other.hosting != program.hosting)
      throw program.written.bad("expected programs of one kind in a scenario, shared objects or commands, got both");
  try {
    programs_->add(hosted(program, robot));
  } catch (const HostingError& error) {
    throw program.written.bad(error.what());
  }
  scenarios_.push_back(program);
  if (program.after.empty()) return start_if_due(programs_->size() - 1);
  look_.node.fire = look;
  look_.programs = this;
  if (!look_.node.in_list())
    kernel::schedule(scheduler_, look_.node, {kernel::global_time(scheduler_), order_of_looks});
}

void RobotPrograms::start_if_due(std::size_t program) {
  try {
    programs_->start_if_due(program);
  } catch (const HostingError& error) {
    throw scenarios_[program].written.bad(error.what());
  }
}

void RobotPrograms::look(kernel::EventNode& node) { reinterpret_cast<Look&>(node).programs->start_those_due(); }

void RobotPrograms::start_those_due() {
  // The start is no action of the task whose event was the last.
  kernel::Task* const task = std::exchange(kernel::running, nullptr);
  for (std::size_t i = 0; i < programs_->size(); ++i) start_if_due(i);
  kernel::running = task;
  if (!programs_->have_all_started())
    kernel::schedule(scheduler_, look_.node, {kernel::global_time(scheduler_) + between_looks, order_of_looks});
}

void RobotPrograms::take_away() {
  if (look_.node.in_list()) kernel::cancel(scheduler_, look_.node);
  programs_.reset();
  scenarios_.clear();
  host_.reset();
  carrier_ = {};
}

std::vector<std::optional<int>> RobotPrograms::exit_statuses(const kernel::Robot& robot) const {
  std::vector<std::optional<int>> statuses;
  for (std::size_t i = 0; programs_ && i < programs_->size(); ++i) {
    if (programs_->program(i).robot != robot.name) continue;
    const std::optional<ProgramEnd> end = programs_->end_of(i);
    statuses.push_back(end ? std::optional(end->exit_status()) : std::nullopt);
  }
  return statuses;
}

}  // namespace waitpoint::run
