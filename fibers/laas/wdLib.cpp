// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/wdLib.hpp"

#include <cerrno>
#include <deque>
#include <utility>
#include <vector>

#include "fibers/laas/ticks.hpp"

namespace waitpoint::laas {

struct wdog : TickAction {
  explicit wdog(Ticks& of) : ticks(of) {}
  void at_tick() override {
    // A copy: the routine may restart its watchdog with another one.
    const std::function<void(long)> call = routine;
    call(parameter);
  }
  Ticks& ticks;
  std::function<void(long)> routine;
  long parameter = 0;
  std::uint64_t rank = 0;  // smaller for later creation
  bool created = false;
};

namespace {

struct Watchdogs : sync::RobotState {
  explicit Watchdogs(kernel::Robot& robot) : ticks(sync::state_of<Ticks>(robot)) {}
  Ticks& ticks;
  std::deque<wdog> all;
  std::vector<wdog*> deleted;  // for reuse
  // The ranks of h2 timers, which follow all watchdogs, are above.
  std::uint64_t next_rank = std::uint64_t{1} << 63;
};

bool is_watchdog(WDOG_ID id) { return id != nullptr && id->created; }

}  // namespace

WDOG_ID wdCreate() {
  auto& watchdogs = sync::state_of<Watchdogs>(*sync::running_task().robot);
  wdog* made = nullptr;
  if (!watchdogs.deleted.empty()) {
    made = watchdogs.deleted.back();
    watchdogs.deleted.pop_back();
  } else if (watchdogs.all.size() < watchdogs_max) {
    made = &watchdogs.all.emplace_back(watchdogs.ticks);
  } else {
    fail(S_wdLib_NOT_ENOUGH_MEMORY);
    return nullptr;
  }
  made->created = true;
  made->rank = --watchdogs.next_rank;
  return made;
}

STATUS wdDelete(WDOG_ID wdId) {
  if (!is_watchdog(wdId)) return fail(S_wdLib_ID_ERROR);
  if (!sync::before_releasing(kernel::Operation::timer_stop, wdId->ticks.object())) return OK;
  if (!is_watchdog(wdId)) return fail(S_wdLib_ID_ERROR);  // another task deleted it first
  wdId->ticks.unlist(*wdId);
  wdId->created = false;
  wdId->routine = nullptr;
  sync::state_of<Watchdogs>(*wdId->ticks.object().robot).deleted.push_back(wdId);
  return OK;
}

STATUS wdStart(WDOG_ID wdId, int delay, std::function<void(long)> pRoutine, long parameter) {
  if (!is_watchdog(wdId)) return fail(S_wdLib_ID_ERROR);
  if (delay < 1 || !pRoutine) return fail(EINVAL);
  if (!sync::before_releasing(kernel::Operation::timer_start, wdId->ticks.object())) return OK;
  wdId->routine = std::move(pRoutine);
  wdId->parameter = parameter;
  Ticks& ticks = wdId->ticks;
  WAITPOINT_REQUIRE(ticks.running(), "a watchdog is started, but h2initGlob() started no clock");
  ticks.list(*wdId, ticks.now() + delay, wdId->rank);
  return OK;
}

STATUS wdCancel(WDOG_ID wdId) {
  if (!is_watchdog(wdId)) return fail(S_wdLib_ID_ERROR);
  if (!sync::before_releasing(kernel::Operation::timer_stop, wdId->ticks.object())) return OK;
  wdId->ticks.unlist(*wdId);
  return OK;
}

}  // namespace waitpoint::laas
