// SPDX-License-Identifier: BSD-3-Clause
// A sorted set as the reference of the event list: the same operations on both give the same events in the same order.
// The number of events rises and falls between none and a hundred thousand, and their times have every distribution
// that is hard for some structure: near and far, tied, in bursts, mostly cancelled, before those that are already out.
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <vector>

#include "core/digest.hpp"
#include "core/random.hpp"
#include "fibers/kernel/event_list.hpp"

namespace waitpoint::kernel {
namespace {

/// The distribution of the times of new events after the present.
enum class Spread {
  near,         ///< within a microsecond
  tied,         ///< multiples of a common period: nearly all events of an instant at once
  many_scales,  ///< as likely between 1 and 2 ns as between 1 and 2 s
  bimodal,      ///< half within 100 ns, half about a millisecond away
  far,          ///< 1 % in the far future, up to the end of time
  bursts,       ///< time stands still for hundreds of events, then jumps
  cancelled,    ///< timeouts that hardly ever expire
  one_instant,  ///< the order alone decides
  anywhere,     ///< also before events that were taken out
};

constexpr const char* names[] = {"Near",   "Tied",      "ManyScales", "Bimodal", "Far",
                                 "Bursts", "Cancelled", "OneInstant", "Anywhere"};

enum class Ties { counted, scattered };

struct Reference {
  std::int64_t time;
  std::uint64_t order;
  std::size_t node;
  friend auto operator<=>(const Reference&, const Reference&) = default;
};

class SideBySide {
 public:
  SideBySide(std::size_t capacity, Spread spread, Ties ties)
      : spread_(spread),
        ties_(ties),
        random_(capacity, names[static_cast<int>(spread)], ties == Ties::counted ? "counted" : "scattered"),
        list_(static_cast<std::uint32_t>(capacity)),
        nodes_(capacity),
        reference_of_(capacity),
        place_(capacity) {
    for (std::size_t node = capacity; node-- > 0;) out_.push_back(node);
  }

  std::size_t size() const { return reference_.size(); }
  std::uint64_t below(std::uint64_t bound) { return random_.below(bound, ++drawn_); }

  void insert() {
    if (in_.empty() && now_ > Time::max().ns() / 2) now_ = 0;  // like a new run
    const std::size_t node = out_.back();
    out_.pop_back();
    const EventKey key = new_key(node);
    if (below(2) == 0 || !list_.try_insert_fast(nodes_[node], key)) list_.insert(nodes_[node], key);
    note_in(node);
  }

  void remove() {
    const std::size_t node = in_[below(in_.size())];
    if (below(2) == 0 || !list_.try_remove_fast(nodes_[node])) list_.remove(nodes_[node]);
    note_out(node);
  }

  void pop() {
    const Reference least = *reference_.begin();
    now_ = least.time;
    ASSERT_EQ(&list_.pop(), &nodes_[least.node]);
    note_out(least.node);
  }

  void pop_and_insert() {
    pop();
    insert();
  }

  void compare() {
    ASSERT_EQ(list_.size(), reference_.size());
    ASSERT_EQ(list_.empty(), reference_.empty());
    if (reference_.empty()) return;
    const Reference& least = *reference_.begin();
    ASSERT_EQ(list_.least().node, &nodes_[least.node]);
    ASSERT_EQ(list_.least().key.time.ns(), least.time);
    ASSERT_EQ(list_.least().key.order, least.order);
  }

 private:
  std::int64_t new_time() {
    const auto span = [this](std::int64_t bound) { return static_cast<std::int64_t>(below(bound)); };
    const auto after = [this](std::int64_t ns) {
      const std::int64_t latest = Time::max().ns();
      return now_ > latest - ns ? latest : now_ + ns;
    };
    switch (spread_) {
      case Spread::near: return after(span(1'000));
      case Spread::tied: return after(0) / 1'000 * 1'000 + 1'000 * (std::int64_t{1} << span(4));
      case Spread::many_scales: return after((std::int64_t{1} << span(30)) + span(1'000));
      case Spread::bimodal: return after(span(2) == 0 ? span(100) : 1'000'000 + span(1'000));
      case Spread::far: return after(span(100) == 0 ? std::int64_t{1} << (30 + span(33)) : span(10'000));
      case Spread::bursts: return span(400) == 0 ? after(1'000'000'000 + span(1'000'000)) : after(span(3));
      case Spread::cancelled: return after(1'000'000'000 + span(1'000'000));
      case Spread::one_instant: return 0;
      default: return span(std::int64_t{1} << 20);
    }
  }

  EventKey new_key(std::size_t node) {
    std::uint64_t order = 0;
    if (below(16) == 0)
      // A timer's event: at the present instant it precedes tasks that were already taken out.
      order = make_order(below(2) == 0 ? Phase::deliveries : Phase::world, node);
    else
      order = make_order(Phase::tasks, ties_ == Ties::counted ? ++inserted_ : Digest::mix(++inserted_));
    const std::int64_t time = below(16) == 0 && spread_ != Spread::anywhere ? now_ : new_time();
    reference_of_[node] = {time, order, node};
    return {Time::from_ns(time), order};
  }

  void note_in(std::size_t node) {
    ASSERT_TRUE(nodes_[node].in_list());
    place_[node] = in_.size();
    in_.push_back(node);
    reference_.insert(reference_of_[node]);
  }

  void note_out(std::size_t node) {
    ASSERT_FALSE(nodes_[node].in_list());
    reference_.erase(reference_of_[node]);
    in_[place_[node]] = in_.back();
    place_[in_.back()] = place_[node];
    in_.pop_back();
    out_.push_back(node);
  }

  Spread spread_;
  Ties ties_;
  RandomStream random_;
  std::uint64_t drawn_ = 0;
  std::uint64_t inserted_ = 0;
  std::int64_t now_ = 0;  // of the last event taken out
  EventList list_;
  std::vector<EventNode> nodes_;
  std::vector<Reference> reference_of_;
  std::set<Reference> reference_;
  std::vector<std::size_t> in_, out_, place_;  // nodes in and outside the list; place_ is the index within in_
};

// Up to `most` events, rising and falling; `operations` of any kind.
void compare_with_reference(Spread spread, Ties ties, std::size_t most, std::size_t operations) {
  SideBySide sides(most + 1, spread, ties);  // one more, for the node put in while the least is taken out
  const std::uint64_t removals = spread == Spread::cancelled ? 15 : 5;
  std::size_t wanted = most;
  for (std::size_t i = 1; i <= operations; ++i) {
    if (i % (2 * most + 50) == 0) {
      const std::size_t levels[] = {0, 1, most / 2, most};
      wanted = levels[sides.below(4)];
    }
    // A quarter of the operations opposes the trend.
    const bool with_tide = sides.below(4) != 0;
    const bool grow = sides.size() == 0 || (sides.size() < most && with_tide == (sides.size() < wanted));
    if (grow)
      sides.insert();
    else if (sides.below(16) < removals)
      sides.remove();
    else if (sides.size() <= wanted && sides.below(4) != 0)
      sides.pop_and_insert();
    else
      sides.pop();
    sides.compare();
    if (testing::Test::HasFatalFailure()) {
      FAIL() << names[static_cast<int>(spread)] << ", at most " << most << " events, operation " << i;
    }
  }
  while (sides.size() > 0 && !testing::Test::HasFatalFailure()) {
    sides.pop();
    sides.compare();
  }
}

class RandomEventList : public testing::TestWithParam<Spread> {};

TEST_P(RandomEventList, AgreesWithASortedSetInCountedOrder) {
  for (const std::size_t most : {1, 2, 10, 100, 1'000, 10'000}) {
    compare_with_reference(GetParam(), Ties::counted, most, 40'000 + 3 * most);
    if (HasFatalFailure()) return;
  }
}

TEST_P(RandomEventList, AgreesWithASortedSetInScatteredOrder) {
  for (const std::size_t most : {1, 2, 10, 100, 1'000, 10'000}) {
    compare_with_reference(GetParam(), Ties::scattered, most, 40'000 + 3 * most);
    if (HasFatalFailure()) return;
  }
}

TEST_P(RandomEventList, AgreesWithASortedSetWithAHundredThousandEvents) {
  compare_with_reference(GetParam(), Ties::scattered, 100'000, 300'000);
}

INSTANTIATE_TEST_SUITE_P(Spreads, RandomEventList,
                         testing::Values(Spread::near, Spread::tied, Spread::many_scales, Spread::bimodal, Spread::far,
                                         Spread::bursts, Spread::cancelled, Spread::one_instant, Spread::anywhere),
                         [](const auto& spread) { return names[static_cast<int>(spread.param)]; });

}  // namespace
}  // namespace waitpoint::kernel
