// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/bag_run.hpp"

#include <algorithm>
#include <chrono>

namespace waitpoint::nodes {
namespace {

constexpr Duration between_looks = std::chrono::milliseconds(50);  // at processes, and at received messages

}  // namespace

BagRun::BagRun(const scenario::PlayScenario& play, bool has_clock, std::unique_ptr<BagSide> bag,
               std::vector<NodeCommand> commands, const Surroundings& surroundings)
    : play_(play),
      has_clock_(has_clock),
      bag_(std::move(bag)),
      processes_(std::move(commands), *bag_),
      surroundings_(surroundings) {}

BagResult BagRun::run(Time limit) {
  limit_ = limit;
  std::optional<End> end = start();
  if (!end) end = play();
  result_.end = end ? *end : wind_down();
  result_.simulated = now_.since_start();
  processes_.end();
  hear();
  result_.topics = bag_->played();
  return result_;
}

std::optional<BagRun::End> BagRun::start() {
  for (Time there_since = now_; now_ - there_since < play_.delay || !processes_.are_there();) {
    if (const auto end = go_on(now_ + between_looks)) return end;
    if (!processes_.are_there()) there_since = now_;
  }
  return std::nullopt;
}

std::optional<BagRun::End> BagRun::play() {
  begin_ = now_;
  is_begun_ = true;
  bag_->play_latched();
  while (const std::optional<std::int64_t> next = bag_->next_ns()) {
    if (const auto end = go_on(in_run(*next))) return end;
    bag_->play_next();
    result_.played = Duration::from_ns(*next);
  }
  result_.is_played = true;
  return std::nullopt;
}

BagRun::End BagRun::wind_down() {
  const Time last = last_heard_ = now_;
  for (;;) {
    if (const auto end = go_on(now_ + between_looks)) return *end;
    if (now_ - last_heard_ >= play_.idle) return End::idle;
    if (now_ - last >= play_.end_most) return End::latest;
  }
}

// Messages that are due on the way.
std::optional<BagRun::End> BagRun::go_on(Time until) {
  for (;;) {
    const std::int64_t tick_ns = Duration::from_seconds(1 / play_.clock_hz).ns() * clock_ticks_;
    const bool has_tick = has_clock_ && is_begun_ && in_run(tick_ns) <= until;
    const Time tick = has_tick ? in_run(tick_ns) : until;
    now_ = std::min({until, tick, next_look_});
    if (now_ >= limit_) return End::limit;
    if (!surroundings_.wait_until(now_)) return End::interrupted;
    if (has_tick && now_ == tick) {
      bag_->show_clock(tick_ns);
      ++clock_ticks_;
    } else if (now_ == next_look_) {
      next_look_ = now_ + between_looks;
      if (const auto end = look_after_nodes()) return end;
    } else {
      return std::nullopt;
    }
  }
}

std::optional<BagRun::End> BagRun::look_after_nodes() {
  hear();
  processes_.go_on(now_);
  for (const NodeNews& news : processes_.take_news()) {
    if (news.is_fault) ++result_.faults;
    surroundings_.tell(now_, news);
  }
  if (processes_.is_over()) return End::required_ended;
  return processes_.have_ended() ? std::optional(End::nodes_ended) : std::nullopt;
}

void BagRun::hear() {
  for (const HeardMessage& message : bag_->hear()) {
    HeardTopic& topic = result_.heard[message.topic];
    topic.type = message.type;
    ++topic.messages;
    topic.digest.add(std::string_view(message.publisher));
    topic.digest.add(std::string_view(message.bytes));
    last_heard_ = now_;
  }
}

Time BagRun::in_run(std::int64_t bag_ns) const {
  return begin_ + Duration::from_ns(static_cast<std::int64_t>(static_cast<double>(bag_ns) / play_.rate));
}

}  // namespace waitpoint::nodes
