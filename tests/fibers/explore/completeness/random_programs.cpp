// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/completeness/random_programs.hpp"

#include <array>

#include "core/random.hpp"

namespace waitpoint::completeness {
namespace {

constexpr std::size_t length_max = 8;

class Maker {
 public:
  Maker(std::uint64_t number, bool has_calls) : draws_(number, "tests", "completeness"), has_calls_(has_calls) {
    is_small_ = number % 2 == 0;
    const std::size_t threads = is_small_ ? (one_in(4) ? 3 : 2) : 2 + below(3);
    for (std::uint8_t& units : program_.units) units = static_cast<std::uint8_t>(below(2));
    for (std::uint8_t& most : most_objects_) most = one_in(3) ? 2 : 1;
    while (kinds_.empty()) draw_kinds();
    has_timeouts_ = one_in(3);
    for (std::size_t i = 0; i < threads; ++i) program_.threads.push_back(make_thread(threads));
    for (std::size_t i = 1; i < threads; ++i) add_creation(i);
  }

  Program take() { return std::move(program_); }

 private:
  enum Kind { locks, tries, conditions, semaphores, atomics, sleeps, skips, exits };
  static constexpr std::size_t kinds = 8;

  std::uint8_t below(std::uint64_t bound) { return static_cast<std::uint8_t>(draws_.below(bound, drawn_++)); }
  bool one_in(std::uint64_t count) { return below(count) == 0; }
  bool times_out() { return has_timeouts_ && one_in(2); }
  std::uint8_t span() { return static_cast<std::uint8_t>(1 + below(2)); }
  std::uint8_t object(Kind kind) { return below(most_objects_[kind]); }

  void draw_kinds() {
    constexpr std::array<std::uint64_t, kinds> rarity{2, 4, 3, 3, 2, 4, 4, 10};  // one in so many programs has the kind
    for (std::size_t kind = 0; kind < kinds; ++kind)
      if (one_in(rarity[kind])) kinds_.push_back(static_cast<Kind>(kind));
  }

  std::vector<Instruction> make_thread(std::size_t threads) {
    const std::size_t most = is_small_ ? (threads == 3 ? 1 : 3) : threads == 2 ? 7 : threads == 3 ? 5 : 3;
    const std::size_t length = 1 + below(most);
    std::vector<Instruction> thread;
    std::array<bool, objects> held{};
    for (int drawn = 0; thread.size() < length && drawn < 20; ++drawn) add(thread, kinds_[below(kinds_.size())], held);
    for (std::uint8_t mutex = 0; mutex < objects; ++mutex)
      if (held[mutex] && !one_in(30)) thread.push_back({Step::unlock, mutex, 0});
    return thread;
  }

  void add(std::vector<Instruction>& thread, Kind kind, std::array<bool, objects>& held) {
    const std::uint8_t which = object(kind == tries ? locks : kind);
    const auto pick = [&](std::initializer_list<Step> steps) { return *(steps.begin() + below(steps.size())); };
    switch (kind) {
      case locks:
        thread.push_back({held[which] ? Step::unlock : Step::lock, which, 0});
        held[which] = !held[which];
        break;
      case tries:
        if (held[which]) break;
        thread.push_back(times_out() ? Instruction{Step::lock_for, which, span()}
                                     : Instruction{Step::try_lock, which, 0});
        thread.push_back({Step::skip, 0, 1});
        thread.push_back({Step::unlock, which, 0});
        break;
      case conditions: add_condition(thread, which, held); break;
      case semaphores: {
        const Step step = has_calls_ && one_in(4)
                              ? Step::count
                              : pick({Step::acquire, Step::release, Step::release, Step::try_acquire});
        thread.push_back(step == Step::acquire && times_out() ? Instruction{Step::acquire_for, which, span()}
                                                              : Instruction{step, which, 0});
        break;
      }
      case atomics: {
        const Step step = pick({Step::load, Step::store, Step::add, Step::replace});
        thread.push_back({step, which, static_cast<std::uint8_t>(1 + below(3))});
        break;
      }
      case sleeps: thread.push_back({Step::sleep, 0, span()}); break;
      case skips: thread.push_back({Step::skip, 0, static_cast<std::uint8_t>(1 + below(2))}); break;
      case exits: thread.push_back({pick({Step::exit, Step::exit_all}), 0, 0}); break;
    }
  }

  // A wait, in a critical section unless one is open; or a notification.
  void add_condition(std::vector<Instruction>& thread, std::uint8_t which, const std::array<bool, objects>& held) {
    if (!one_in(2)) {
      thread.push_back({one_in(2) ? Step::signal : Step::broadcast, which, 0});
      return;
    }
    if (!held[which]) thread.push_back({Step::lock, which, 0});
    thread.push_back(times_out() ? Instruction{Step::wait_for, which, span()} : Instruction{Step::wait, which, 0});
    if (!held[which]) thread.push_back({Step::unlock, which, 0});
  }

  // An earlier thread creates `made` in its first half, and may join it later.
  void add_creation(std::size_t made) {
    std::size_t maker = one_in(4) ? below(made) : 0;
    if (program_.threads[maker].size() >= length_max) maker = 0;
    std::vector<Instruction>& thread = program_.threads[maker];
    const auto insert = [&](std::size_t place, Step step) {
      thread.insert(thread.begin() + static_cast<std::ptrdiff_t>(place), {step, static_cast<std::uint8_t>(made), 0});
    };
    const std::size_t place = below(thread.size() / 2 + 1);
    insert(place, Step::create);
    if (one_in(3)) insert(place + 1 + below(thread.size() - place), Step::join);
  }

  RandomStream draws_;
  std::uint64_t drawn_ = 0;
  bool is_small_ = false, has_timeouts_ = false, has_calls_;
  std::array<std::uint8_t, kinds> most_objects_{};
  std::vector<Kind> kinds_;
  Program program_;
};

}  // namespace

Program make_program(std::uint64_t number, bool has_calls) { return Maker(number, has_calls).take(); }

}  // namespace waitpoint::completeness
