// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/link.hpp"

#include "fibers/kernel/messages.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"

#include <algorithm>
#include <utility>

namespace waitpoint::io {
namespace {

// Random draws per message: each has an index of the link's stream.
enum Draw : std::uint64_t { of_latency, of_loss };

// The exploration strategy that also decides about the media's latencies and losses; else null.
kernel::Decisions* deciding_strategy(kernel::Scheduler& scheduler) {
  return kernel::running != nullptr ? kernel::chooser(scheduler).decisions() : nullptr;
}

RandomStream stream(kernel::Scheduler& scheduler, const kernel::Robot& from, const std::string& to) {
  return {kernel::chooser(scheduler).seed(), from.name, "medium to " + to};
}

}  // namespace

Link::Link(kernel::Scheduler& scheduler, kernel::Robot& from, std::string to, Receiver& receiver,
           std::optional<Medium> medium, const Distance& distance, std::size_t in_flight_max, const Forward* forward)
    : scheduler_(scheduler),
      from_(from),
      to_(std::move(to)),
      receiver_(receiver),
      medium_(medium),
      distance_(distance),
      in_flight_max_(in_flight_max),
      forward_(forward),
      random_(stream(scheduler, from, to_)) {
  range_check_.link = this;
  range_check_.fire = look_again;
}

void Link::reseed() { random_ = stream(scheduler_, from_, to_); }

void Link::stop() {
  stopped_ = true;
  if (range_check_.in_list()) kernel::cancel(scheduler_, range_check_);
  for (Flight& flight : flights_)
    if (flight.in_list()) kernel::cancel(scheduler_, flight);
  flights_.clear();
  free_flights_.clear();
  waiting_.clear();
}

double Link::distance_m() const {
  const double distance_m = distance_ == nullptr ? 0 : distance_(from_.name, to_);
  WAITPOINT_REQUIRE(distance_m >= 0, "the distance between two robots is negative or not a number");
  return distance_m;
}

// The arrival time of a message whose last bit follows those of all earlier messages.
Time Link::put_on_air(std::size_t bytes, double distance_m) {
  ++number_;
  free_at_ = std::max(free_at_, kernel::global_time(scheduler_)) + time_on_air(*medium_, bytes);
  return free_at_ + latency() + Duration::from_seconds(medium_->latency_per_metre.seconds() * distance_m);
}

Duration Link::latency() const {
  const Duration spread = medium_->latency_most - medium_->latency_least;
  if (spread == Duration()) return medium_->latency_least;
  if (kernel::Decisions* decisions = deciding_strategy(scheduler_))
    return decisions->computing(*kernel::running, medium_->latency_least, medium_->latency_most);
  const std::uint64_t drawn_ns = random_.below(static_cast<std::uint64_t>(spread.ns()) + 1, number_, Draw::of_latency);
  return medium_->latency_least + Duration::from_ns(static_cast<std::int64_t>(drawn_ns));
}

bool Link::is_lost() const {
  if (medium_->loss == 0) return false;
  if (kernel::Decisions* decisions = deciding_strategy(scheduler_))
    return decisions->among(kernel::Choice::loss, *kernel::running, 2) != 0;
  return random_.uniform(number_, Draw::of_loss) < medium_->loss;
}

void Link::begin_sending() {
  WAITPOINT_REQUIRE(!stopped_, "a message is sent on a network that was destroyed");
  ++statistics.sent;
}

bool Link::send_datagram(std::size_t bytes, Packet packet) {
  begin_sending();
  if (!medium_) {
    receiver_.receive(*this, packet);
    return true;
  }
  const Duration queued = std::max(free_at_, kernel::global_time(scheduler_)) - kernel::global_time(scheduler_);
  if (queued > time_on_air(*medium_, medium_->queue_bytes)) {
    ++statistics.overflowed;
    return false;
  }
  const double away_m = distance_m();
  const bool in_range = away_m <= medium_->range_m;
  // A lost message occupies the medium all the same.
  const Time arrives = put_on_air(bytes, in_range ? away_m : 0);
  if (!in_range || is_lost()) {
    ++(in_range ? statistics.lost : statistics.out_of_range);
    return false;
  }
  launch(arrives, std::move(packet));
  return true;
}

void Link::send_in_order(std::size_t bytes, Packet packet) {
  begin_sending();
  if (!medium_) return receiver_.receive(*this, packet);
  const double away_m = distance_m();
  if (waiting_.empty() && away_m <= medium_->range_m) return transmit_in_order(bytes, away_m, std::move(packet));
  check_room();
  waiting_.push_back({bytes, std::move(packet)});
  if (!range_check_.in_list())
    kernel::deliver(scheduler_, range_check_, kernel::global_time(scheduler_) + medium_->range_check, from_);
}

void Link::look_again(kernel::EventNode& node) {
  Link& self = *static_cast<RangeCheck&>(node).link;
  const double away_m = self.distance_m();
  if (away_m > self.medium_->range_m) {
    kernel::deliver(self.scheduler_, node, kernel::global_time(self.scheduler_) + self.medium_->range_check,
                    self.from_);
    return;
  }
  for (; !self.waiting_.empty(); self.waiting_.pop_front())
    self.transmit_in_order(self.waiting_.front().bytes, away_m, std::move(self.waiting_.front().packet));
}

void Link::transmit_in_order(std::size_t bytes, double distance_m, Packet&& packet) {
  in_order_until_ = std::max(in_order_until_, put_on_air(bytes, distance_m));
  launch(in_order_until_, std::move(packet));
}

void Link::check_room() const {
  WAITPOINT_REQUIRE(flights_.size() - free_flights_.size() + waiting_.size() <= in_flight_max_,
                    "more messages in transit between two robots than NetworkLimits::in_flight_max");
}

// A flight to another process has the same event here, which only makes room: the bound is that of one process.
void Link::launch(Time arrives, Packet&& packet) {
  check_room();
  WAITPOINT_CHECK(arrives - kernel::global_time(scheduler_) >= kernel::lookahead(scheduler_),
                  "a message arrives within the lookahead");
  Flight& flight = take_flight();
  kernel::deliver(scheduler_, flight, arrives, from_);
  if (forward_ == nullptr)
    flight.packet = std::move(packet);
  else
    (*forward_)(from_, from_.messages, arrives, to_, std::move(packet));
}

void Link::arrive_at(Time time, std::uint64_t count, Packet packet) {
  WAITPOINT_CHECK(!stopped_ && forward_ == nullptr, "a packet comes to a process without its receiver");
  Flight& flight = take_flight();
  flight.packet = std::move(packet);
  kernel::deliver(scheduler_, flight, time, from_, count);
}

Link::Flight& Link::take_flight() {
  if (!free_flights_.empty()) {
    Flight& flight = *free_flights_.back();
    free_flights_.pop_back();
    return flight;
  }
  Flight& flight = flights_.emplace_back();
  flight.link = this;
  flight.fire = land;
  return flight;
}

void Link::land(kernel::EventNode& node) {
  auto& flight = static_cast<Flight&>(node);
  Link& self = *flight.link;
  Packet packet = std::move(flight.packet);
  self.free_flights_.push_back(&flight);
  if (self.forward_ == nullptr) self.receiver_.receive(self, packet);
}

}  // namespace waitpoint::io
