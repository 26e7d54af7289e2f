// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/semLib.hpp"

#include <cerrno>
#include <deque>
#include <vector>

#include "fibers/laas/semaphore.hpp"

namespace waitpoint::laas {
namespace {

struct Semaphores : sync::RobotState {
  explicit Semaphores(kernel::Robot& of) : robot(of) {}
  kernel::Robot& robot;
  std::deque<Semaphore> all;
  std::vector<Semaphore*> deleted;  // for reuse
};

SEM_ID create(Semaphore::Kind kind, int count) {
  auto& semaphores = sync::state_of<Semaphores>(*sync::running_task().robot);
  Semaphore* made = nullptr;
  if (!semaphores.deleted.empty()) {
    made = semaphores.deleted.back();
    semaphores.deleted.pop_back();
  } else if (semaphores.all.size() < semaphores_max) {
    made = &semaphores.all.emplace_back(semaphores.robot);
  } else {
    fail(S_semLib_TOO_MANY_SEM);
    return nullptr;
  }
  made->create(kind, count);
  return made;
}

bool is_semaphore(SEM_ID id) { return id != nullptr && id->kind() != Semaphore::Kind::none; }

}  // namespace

SEM_ID semBCreate(int, SEM_B_STATE initialState) { return create(Semaphore::Kind::count, initialState); }

SEM_ID semCCreate(int, int initialCount) {
  if (initialCount >= 0) return create(Semaphore::Kind::count, initialCount);
  fail(EINVAL);
  return nullptr;
}

SEM_ID semMCreate(int) { return create(Semaphore::Kind::mutex, 0); }

STATUS semDelete(SEM_ID semId) {
  if (!is_semaphore(semId)) return fail(S_semLib_NOT_A_SEM);
  if (!sync::before_releasing(kernel::Operation::release, semId->object())) return OK;
  if (!is_semaphore(semId)) return fail(S_semLib_NOT_A_SEM);  // another task deleted it first
  semId->destroy();
  sync::state_of<Semaphores>(*semId->object().robot).deleted.push_back(semId);
  return OK;
}

STATUS semGive(SEM_ID semId) {
  if (!is_semaphore(semId)) return fail(S_semLib_NOT_A_SEM);
  const int error = semId->give();
  return error == 0 ? OK : fail(error);
}

STATUS semTake(SEM_ID semId, int timeout) {
  if (!is_semaphore(semId)) return fail(S_semLib_NOT_A_SEM);
  if (timeout < WAIT_FOREVER) return fail(EINVAL);
  const TakeResult taken = semId->take(timeout);
  if (taken == TakeResult::taken) return OK;
  return fail(taken == TakeResult::timed_out ? S_semLib_TIMEOUT : S_semLib_NOT_A_SEM);
}

STATUS semFlush(SEM_ID semId) {
  if (!is_semaphore(semId)) return fail(S_semLib_NOT_A_SEM);
  if (semId->kind() == Semaphore::Kind::mutex) return fail(EINVAL);
  semId->flush();
  return OK;
}

}  // namespace waitpoint::laas
