// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/simulation.hpp"

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <vector>

#include "fibers/sync/blocked_report.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

Simulation::Simulation(SimulationOptions options)
    : options_(std::move(options)), scheduler_(options_.order, options_.seed) {
  scheduler_.set_client(this);
  scheduler_.set_replay(options_.replay.c_str());
  scheduler_.add(environment_, "environment");
}

Simulation::~Simulation() { scheduler_.unwind(); }

kernel::Robot& Simulation::add_robot(const std::string& name) {
  WAITPOINT_CHECK(name.size() < kernel::name_size, "a robot's name is too long");
  for (const kernel::Robot& robot : robots_) WAITPOINT_CHECK(name != robot.name, "two robots of one name");
  kernel::Robot& robot = robots_.emplace_back();
  scheduler_.add(robot, name.c_str());
  return robot;
}

void Simulation::spawn(kernel::Robot& robot, const kernel::SpawnOptions& options, std::function<void()> body) {
  sync::start_thread(scheduler_, robot, options, std::move(body));
}

RunEnd Simulation::run_before(Time until) {
  const kernel::RunState state = scheduler_.run_before(until);
  if (failure_ != nullptr) std::rethrow_exception(std::exchange(failure_, nullptr));
  if (state == kernel::RunState::reached) return RunEnd::time_reached;
  if (state == kernel::RunState::stopped && scheduler_.stop_cause() == kernel::StopCause::ended) return RunEnd::ended;
  if (state == kernel::RunState::stopped && scheduler_.stop_cause() == kernel::StopCause::no_progress) {
    trouble_ = sync::describe_spinning(scheduler_);
    return RunEnd::no_progress;
  }
  trouble_ = sync::describe_deadlock(scheduler_);
  return RunEnd::deadlock;
}

Digest Simulation::digest() const {
  std::vector<const kernel::Robot*> in_order;
  for (const kernel::Robot& robot : robots_) in_order.push_back(&robot);
  std::sort(in_order.begin(), in_order.end(),
            [](const auto* a, const auto* b) { return std::string_view(a->name) < std::string_view(b->name); });
  Digest digest;
  for (const kernel::Robot* robot : in_order) {
    digest.add(std::string_view(robot->name));
    digest.add(robot->digest.value());
  }
  digest.add(environment_.digest.value());
  return digest;
}

void Simulation::fail(std::exception_ptr failure) {
  if (failure_ == nullptr) failure_ = std::move(failure);
  scheduler_.stop(kernel::StopCause::requested);
}

std::ostream& operator<<(std::ostream& out, const Report& report) {
  if (report.passed)
    return out << "passed at " << to_string(report.end_time) << " s, " << report.events << " events, "
               << to_string(report.digest);
  return out << report.text;
}

Report simulate(std::function<void()> body, SimulationOptions options) {
  if (const char* seed = std::getenv("WAITPOINT_SEED"); seed != nullptr && *seed != '\0') {
    options.order = kernel::Order::seeded;
    options.seed = std::strtoull(seed, nullptr, 10);
  }
  if (options.replay.empty() && options.order == kernel::Order::seeded)
    options.replay = "WAITPOINT_SEED=" + std::to_string(options.seed) + " and the same test again";
  const std::string replay = options.replay;
  Report report;
  Simulation simulation(std::move(options));
  simulation.spawn(simulation.environment(), {.name = "main"}, std::move(body));
  try {
    report.end = simulation.run_before();
    report.text = simulation.trouble();
  } catch (const std::exception& failure) {
    report.text = std::string("an exception escaped from a task: ") + failure.what();
  } catch (...) {
    report.text = "an exception of unknown type escaped from a task";
  }
  report.digest = simulation.digest();
  report.end_time = simulation.global_time();
  report.events = simulation.scheduler().events();
  report.passed = report.text.empty() && report.end == RunEnd::ended;
  if (!report.passed && !replay.empty()) report.text += "\nreplay: " + replay;
  return report;
}

}  // namespace waitpoint
