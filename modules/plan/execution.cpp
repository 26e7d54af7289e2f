// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/execution.hpp"

#include <algorithm>

namespace waitpoint::plan {
namespace {
constexpr Duration tick = Duration::from_ns(1);
}

Execution::Execution(const TemporalPlan& plan)
    : plan_(plan),
      situation_(plan),
      running_(plan.actions.size()),
      to_stop_(plan.actions.size()),
      not_before_(plan.actions.size()) {
  const bool consistent = rebuild({});
  WAITPOINT_CHECK(consistent, "an inconsistent plan is executed");
}

// The network of the present situation; false if it is not consistent.
bool Execution::rebuild(Duration now) {
  situation_.now = now;
  auto network = std::make_unique<PlanNetwork>(plan_, situation_);
  auto dispatcher = std::make_unique<Dispatcher>(network->network());
  if (!dispatcher->consistent()) return false;
  for (PointId point = 1; point < situation_.times.size(); ++point)
    if (situation_.times[point] && situation_.is_active(plan_, action_of(point)) &&
        !dispatcher->execute(point, *situation_.times[point]))
      return false;
  network_ = std::move(network);
  dispatcher_ = std::move(dispatcher);
  return true;
}

bool Execution::is_ahead(PointId point) const {
  return !situation_.times[point] && situation_.is_active(plan_, action_of(point));
}

PlanOrder Execution::next(Duration now) {
  if (now > bound_max) abort(now, "it lasts longer than 1000000 s");
  while (failure_.empty() && !completed_ && check_late(now)) {
  }
  for (std::size_t i = 0; i < to_stop_.size(); ++i) {
    if (!to_stop_[i]) continue;
    to_stop_[i] = running_[i] = false;
    return {PlanOrder::Kind::stop, i};
  }
  if (completed_ || !failure_.empty()) return {};
  PlanOrder order{PlanOrder::Kind::wait, 0, Duration::max()};
  bool is_done = true;
  for (PointId point = 1; point < situation_.times.size(); ++point) {
    if (!is_ahead(point)) continue;
    is_done = false;
    const std::size_t action = action_of(point);
    // The tick after the latest time is late.
    if (dispatcher_->latest(point) < bound_max) order.until = std::min(order.until, dispatcher_->latest(point) + tick);
    std::optional<Duration> ready = dispatcher_->ready_at(point);
    if (!ready) continue;
    if (is_start(point)) ready = std::max(*ready, not_before_[action]);
    if (*ready > now) {
      order.until = std::min(order.until, *ready);
    } else if (is_start(point)) {
      return {PlanOrder::Kind::start, action};
    } else {
      set(point, now);
      note(now, EventKind::stop, action);
      const bool runs = running_[action];
      running_[action] = false;
      if (runs) return {PlanOrder::Kind::stop, action};
      return next(now);
    }
  }
  if (!is_done) return order;
  completed_ = true;
  note(now, EventKind::completed, 0);
  return {};
}

// Treats the first point whose latest time has passed; false if there is none.
bool Execution::check_late(Duration now) {
  for (PointId point = 1; point < situation_.times.size(); ++point) {
    if (!is_ahead(point) || dispatcher_->latest(point) >= now) continue;
    const std::size_t action = action_of(point);
    if (is_start(point) || situation_.loosened[action] || !plan_.actions[action].contingent) {
      fail(action, now, is_start(point) ? "it could not start in time" : "it did not end in time");
      return true;
    }
    note(now, EventKind::late, action);
    situation_.loosened[action] = true;
    if (rebuild(now))
      note(now, EventKind::repaired, action);
    else
      fail(action, now, "it did not end in time");
    return true;
  }
  return false;
}

void Execution::set(PointId point, Duration now) {
  const bool allowed = dispatcher_->execute(point, now);
  WAITPOINT_CHECK(allowed, "a point is executed that is not ready");
  situation_.times[point] = now;
}

void Execution::started(std::size_t action, Duration now) {
  running_[action] = plan_.actions[action].request || !plan_.actions[action].rendezvous.empty();
  note(now, EventKind::start, action);
  // The conditions and the request may have taken time.
  if (!dispatcher_->execute(start_of(action), now)) return fail(action, now, "it could not start in time");
  situation_.times[start_of(action)] = now;
}

void Execution::ended(std::size_t action, Duration now, bool succeeded, const std::string& report) {
  if (!running_[action]) return;  // of a stopped one
  // The effect of its request lasts until the request `stop`.
  running_[action] = succeeded && !plan_.actions[action].contingent && plan_.actions[action].stop.has_value();
  if (!succeeded) return fail(action, now, report);
  if (plan_.actions[action].contingent) end(action, now);
}

void Execution::end(std::size_t action, Duration now) {
  note(now, EventKind::end, action);
  situation_.times[end_of(action)] = now;
  if (dispatcher_->execute(end_of(action), now)) return;
  const Duration took = now - *situation_.times[start_of(action)];
  const bool early = took<plan_.actions[action].least, late = took> plan_.actions[action].most;
  if (early || late) note(now, early ? EventKind::early : EventKind::late, action);
  situation_.loosened[action] = true;
  if (rebuild(now)) return note(now, EventKind::repaired, action);
  const char* const reason = early  ? "it ended too early"
                             : late ? "it ended too late"
                                    : "its end contradicts the constraints";
  fail(action, now, reason);
}

void Execution::fail(std::size_t action, Duration now, const std::string& reason) {
  note(now, EventKind::failed, action, reason);
  const std::string failure = "action '" + plan_.actions[action].name + "' failed: " + reason;
  const std::optional<std::size_t> alternative = plan_.actions[action].alternative;
  if (!alternative) return abort(now, failure);
  std::size_t& branch = situation_.branch[*alternative];
  for (std::size_t i = 0; i < plan_.actions.size(); ++i)
    if (plan_.actions[i].alternative == alternative && plan_.actions[i].branch == branch && running_[i])
      to_stop_[i] = true;
  while (++branch < plan_.alternatives[*alternative].branches) {
    if (!rebuild(now)) continue;
    note(now, EventKind::branch, *alternative, std::to_string(branch + 1));
    return;
  }
  abort(now, failure);
}

void Execution::abort(Duration now, const std::string& reason) {
  if (!failure_.empty() || completed_) return;
  failure_ = reason;
  note(now, EventKind::aborted, 0, reason);
  for (std::size_t i = 0; i < running_.size(); ++i) to_stop_[i] = running_[i];
}

}  // namespace waitpoint::plan
