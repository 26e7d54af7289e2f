// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/h2semLib.hpp"

#include <cerrno>
#include <deque>
#include <set>

#include "fibers/laas/semaphore.hpp"

namespace waitpoint::laas {
namespace {

struct H2Semaphores : sync::RobotState {
  explicit H2Semaphores(kernel::Robot& of) : robot(of) {}
  kernel::Robot& robot;
  std::deque<Semaphore> all;   // starts with number 1
  std::set<H2SEM_ID> deleted;  // for reuse, the least first
};

H2Semaphores& here() { return sync::state_of<H2Semaphores>(*sync::running_task().robot); }

Semaphore* find(H2SEM_ID sem) {
  auto& all = here().all;
  if (sem < 1 || static_cast<std::size_t>(sem) > all.size()) return nullptr;
  Semaphore& found = all[static_cast<std::size_t>(sem - 1)];
  return found.kind() == Semaphore::Kind::none ? nullptr : &found;
}

}  // namespace

H2SEM_ID h2semAlloc(int type) {
  if (type != H2SEM_SYNC && type != H2SEM_EXCL) return fail(S_h2semLib_BAD_SEM_TYPE);
  H2Semaphores& semaphores = here();
  H2SEM_ID sem = 0;
  if (!semaphores.deleted.empty()) {
    sem = semaphores.deleted.extract(semaphores.deleted.begin()).value();
  } else {
    if (semaphores.all.size() == h2_semaphores_max) return fail(S_h2semLib_TOO_MANY_SEM);
    semaphores.all.emplace_back(semaphores.robot, "h2");
    sem = static_cast<H2SEM_ID>(semaphores.all.size());
  }
  semaphores.all[static_cast<std::size_t>(sem - 1)].create(Semaphore::Kind::count, type == H2SEM_EXCL ? 1 : 0);
  return sem;
}

STATUS h2semDelete(H2SEM_ID sem) {
  Semaphore* const found = find(sem);
  if (found == nullptr) return fail(S_h2semLib_NOT_A_SEM);
  if (!sync::before_releasing(kernel::Operation::release, found->object())) return OK;
  if (find(sem) == nullptr) return fail(S_h2semLib_NOT_A_SEM);  // another task deleted it first
  found->destroy();
  here().deleted.insert(sem);
  return OK;
}

BOOL h2semTake(H2SEM_ID sem, int timeout) {
  Semaphore* const found = find(sem);
  int error = S_h2semLib_NOT_A_SEM;
  if (found != nullptr && timeout < WAIT_FOREVER) error = EINVAL;
  if (found != nullptr && timeout >= WAIT_FOREVER) {
    const TakeResult taken = found->take(timeout == 0 ? WAIT_FOREVER : timeout);
    if (taken == TakeResult::taken) return TRUE;
    if (taken == TakeResult::timed_out) error = S_h2semLib_TIMEOUT;
  }
  fail(error);
  return FALSE;
}

STATUS h2semGive(H2SEM_ID sem) {
  Semaphore* const found = find(sem);
  if (found == nullptr) return fail(S_h2semLib_NOT_A_SEM);
  const int error = found->give();
  return error == 0 ? OK : fail(error);
}

BOOL h2semFlush(H2SEM_ID sem) { return h2semSet(sem, 0) == OK ? TRUE : FALSE; }

STATUS h2semSet(H2SEM_ID sem, int value) {
  Semaphore* const found = find(sem);
  if (found == nullptr) return fail(S_h2semLib_NOT_A_SEM);
  if (value < 0) return fail(EINVAL);
  found->set(value);
  return OK;
}

}  // namespace waitpoint::laas
