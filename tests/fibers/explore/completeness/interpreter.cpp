// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/interpreter.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <sstream>

#include "core/error.hpp"
#include "fibers/explore/body.hpp"
#include "fibers/explore/search/omissions.hpp"
#include "fibers/explore/strategies/factory.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::completeness {
namespace {

constexpr std::array<const char*, threads_max> names{"main", "T1", "T2", "T3"};

// Ends the run from within a thread.
struct Ended {};

class Run {
 public:
  explicit Run(const Program& program)
      : program_(program), units_{counting_semaphore<>(program.units[0]), counting_semaphore<>(program.units[1])} {
    observed_.reads.resize(program.threads.size());
    observed_.values.resize(objects);
  }

  void execute(std::size_t thread) {
    Held held;
    const std::vector<Instruction>& all = program_.threads[thread];
    std::vector<int>& reads = observed_.reads[thread];
    for (std::size_t place = 0; place < all.size() && all[place].step != Step::exit; ++place) {
      if (all[place].step == Step::skip)
        place += !reads.empty() && reads.back() == 0 ? all[place].operand : 0;
      else
        execute(all[place], thread, held);
    }
    require(!held.mutexes[0] && !held.mutexes[1], thread);
  }

  /// The outcome of the run with this result; `failure` as in exploration::Body.
  std::string outcome_of(const std::string& failure) const {
    if (!ending_.empty()) return outcome(ending_, {ended_by_}, observed_);
    if (failure.empty()) return outcome("ended", {}, observed_);
    const bool is_cycle =
        failure.find("each other") != failure.npos || failure.find("waits for itself") != failure.npos;
    std::vector<std::size_t> threads;
    std::istringstream lines(failure);
    for (std::string line; std::getline(lines, line);)
      for (std::size_t t = 0; t < threads_max; ++t)
        if (line.starts_with(std::string("  task ") + names[t] + " ")) threads.push_back(t);
    std::sort(threads.begin(), threads.end());
    return threads.empty() ? failure : outcome(is_cycle ? "cycle" : "stuck", threads, observed_);
  }

 private:
  // What the thread may unlock and join.
  struct Held {
    std::array<bool, objects> mutexes{};
    std::array<bool, threads_max> threads{};
  };

  static bool is_over() { return kernel::is_unwinding(*kernel::running->scheduler); }

  // An event that ends the run.
  [[noreturn]] void end(const char* how, std::size_t thread) {
    waitpoint::atomic_thread_fence(memory_order_seq_cst);
    if (!is_over()) {
      ending_ = how;
      ended_by_ = thread;
    }
    throw Ended();
  }
  void require(bool is_met, std::size_t thread) {
    if (!is_met) end("misuse", thread);
  }

  // After the end of the run, primitives may return without effect.
  void read(std::size_t thread, int value) {
    if (!is_over()) observed_.reads[thread].push_back(value);
  }
  void write(std::size_t object, int value) {
    if (!is_over()) observed_.values[object] = value;
  }

  void execute(const Instruction& instruction, std::size_t thread, Held& held) {
    const auto [step, object, operand] = instruction;
    const auto other = object;
    switch (step) {
      case Step::create:
        held.threads[other] = true;
        threads_[other] =
            waitpoint::thread(thread_attributes{.name = names[other]}, [this, other = other] { execute(other); });
        break;
      case Step::join:
        require(held.threads[other], thread);
        held.threads[other] = false;
        threads_[other].join();
        break;
      case Step::lock:
        mutexes_[object].lock();
        held.mutexes[object] = true;
        break;
      case Step::try_lock:
        require(!held.mutexes[object], thread);
        held.mutexes[object] = mutexes_[object].try_lock();
        read(thread, held.mutexes[object]);
        break;
      case Step::lock_for:
        require(!held.mutexes[object], thread);
        held.mutexes[object] = mutexes_[object].try_lock_for(std::chrono::seconds(operand));
        read(thread, held.mutexes[object]);
        break;
      case Step::unlock:
        require(held.mutexes[object], thread);
        held.mutexes[object] = false;
        mutexes_[object].unlock();
        break;
      case Step::wait:
      case Step::wait_for: {
        require(held.mutexes[object], thread);
        std::unique_lock<mutex> lock(mutexes_[object], std::adopt_lock);
        if (step == Step::wait)
          conditions_[object].wait(lock);
        else
          read(thread, conditions_[object].wait_for(lock, std::chrono::seconds(operand)) == cv_status::no_timeout);
        lock.release();
        break;
      }
      case Step::signal: conditions_[object].notify_one(); break;
      case Step::broadcast: conditions_[object].notify_all(); break;
      case Step::acquire: units_[object].acquire(); break;
      case Step::acquire_for: read(thread, units_[object].try_acquire_for(std::chrono::seconds(operand))); break;
      case Step::try_acquire: read(thread, units_[object].try_acquire()); break;
      case Step::release: units_[object].release(); break;
      case Step::count: throw BadInput("program", "a semaphore's units are read by POSIX threads only: --exec");
      case Step::sleep: this_thread::sleep_for(std::chrono::seconds(std::max<int>(operand, 1))); break;
      case Step::exit_all: end("exit", thread);
      default: access(instruction, thread);
    }
  }

  // An atomic.
  void access(const Instruction& instruction, std::size_t thread) {
    const auto [step, object, operand] = instruction;
    int before = 0;
    switch (step) {
      case Step::load: read(thread, values_[object].load()); break;
      case Step::store:
        values_[object].store(operand);
        write(object, operand);
        break;
      case Step::add:
        before = values_[object].fetch_add(operand);
        read(thread, before);
        write(object, before + operand);
        break;
      case Step::replace: {
        const bool is_replaced = values_[object].compare_exchange_strong(before, operand);
        read(thread, before);
        if (is_replaced) write(object, operand);
        break;
      }
      default: break;
    }
  }

  const Program& program_;
  std::array<timed_mutex, objects> mutexes_;
  std::array<condition_variable, objects> conditions_;
  std::array<counting_semaphore<>, objects> units_;
  std::array<atomic<int>, objects> values_{};
  std::array<waitpoint::thread, threads_max> threads_;
  Observed observed_;
  std::string ending_;  // of a run that a thread has ended
  std::size_t ended_by_ = 0;
};

}  // namespace

Covered cover(const Program& program, const std::string& strategy, std::uint64_t schedules_max) {
  std::unique_ptr<Run> run;
  exploration::Body body([&] { run->execute(0); }, nullptr, Time::max(), 100'000);
  const auto chosen = exploration::make_strategy(strategy);
  Covered covered;
  exploration::Omissions omissions;
  exploration::Profile profile;
  while (covered.schedules < schedules_max && !covered.is_finished) {
    run = std::make_unique<Run>(program);
    chosen->begin(covered.schedules, exploration::Draws(1, strategy, covered.schedules), profile);
    const exploration::RunVerdict verdict = body.run(*chosen);
    ++covered.schedules;
    if (!verdict.was_cut) covered.outcomes.insert(run->outcome_of(body.failure()));
    omissions.take(verdict, body.explorer().schedule().decisions);
    covered.is_finished = !chosen->end();
  }
  covered.leaves_turns = omissions.turns();
  return covered;
}

void draw(const Program& program, std::uint64_t schedules,
          const std::function<void(std::span<const exploration::ReadsFrom> pairs)>& take) {
  std::unique_ptr<Run> run;
  exploration::Body body([&] { run->execute(0); }, nullptr, Time::max(), 100'000);
  const std::string strategy = "random";
  const auto chosen = exploration::make_strategy(strategy);
  exploration::ReadsFromRelation relation;
  body.explorer().record(&relation);
  for (std::uint64_t number = 0; number < schedules; ++number) {
    run = std::make_unique<Run>(program);
    chosen->begin(number, exploration::Draws(1, strategy, number), {});
    (void)body.run(*chosen);
    take(relation.pairs());
  }
}

}  // namespace waitpoint::completeness
