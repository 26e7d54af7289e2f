// SPDX-License-Identifier: BSD-3-Clause
//
// <threads.h>: the same threads, mutexes and conditions under C11's names. Its types have the same layouts.
#include <threads.h>

#include <cerrno>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/threads/thread.hpp"

namespace waitpoint::posix {
namespace {

int c11(int error) {
  switch (error) {
    case 0: return thrd_success;
    case ENOMEM: return thrd_nomem;
    case ETIMEDOUT: return thrd_timedout;
    case EBUSY: return thrd_busy;
    default: return thrd_error;
  }
}

pthread_mutex_t* posix_of(mtx_t* mutex) { return reinterpret_cast<pthread_mutex_t*>(mutex); }
pthread_cond_t* posix_of(cnd_t* condition) { return reinterpret_cast<pthread_cond_t*>(condition); }
static_assert(sizeof(mtx_t) == sizeof(pthread_mutex_t) && sizeof(cnd_t) == sizeof(pthread_cond_t));
static_assert(alignof(mtx_t) >= alignof(pthread_mutex_t) && alignof(cnd_t) >= alignof(pthread_cond_t));
static_assert(sizeof(thrd_t) == sizeof(pthread_t) && sizeof(int) <= sizeof(void*));

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int thrd_create(thrd_t* id, thrd_start_t start, void* argument) {
  const int error = create(id, nullptr, {.c11 = start}, true, argument);
  return error == EAGAIN ? thrd_nomem : c11(error);
}
WAITPOINT_INTERPOSED int thrd_join(thrd_t id, int* result) {
  void* value = nullptr;
  const int error = join(id, &value, Time::max());
  if (error == 0 && result != nullptr) *result = static_cast<int>(reinterpret_cast<std::intptr_t>(value));
  return c11(error);
}
extern "C" [[gnu::visibility("default")]] int waitpoint_thrd_equal(thrd_t one, thrd_t other) __asm__("thrd_equal");
int waitpoint_thrd_equal(thrd_t one, thrd_t other) { return are_equal(one, other) ? 1 : 0; }
WAITPOINT_INTERPOSED int thrd_detach(thrd_t id) { return c11(pthread_detach(id)); }
WAITPOINT_INTERPOSED void thrd_exit(int result) {
  pthread_exit(reinterpret_cast<void*>(static_cast<std::intptr_t>(result)));
}

WAITPOINT_INTERPOSED int mtx_init(mtx_t* mutex, int type) {
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  if ((type & mtx_recursive) != 0) pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_RECURSIVE);
  return (type & ~(mtx_recursive | mtx_timed)) != 0 ? thrd_error
                                                    : c11(pthread_mutex_init(posix_of(mutex), &attributes));
}
WAITPOINT_INTERPOSED void mtx_destroy(mtx_t* mutex) { pthread_mutex_destroy(posix_of(mutex)); }
WAITPOINT_INTERPOSED int mtx_lock(mtx_t* mutex) { return c11(pthread_mutex_lock(posix_of(mutex))); }
WAITPOINT_INTERPOSED int mtx_trylock(mtx_t* mutex) { return c11(pthread_mutex_trylock(posix_of(mutex))); }
WAITPOINT_INTERPOSED int mtx_unlock(mtx_t* mutex) { return c11(pthread_mutex_unlock(posix_of(mutex))); }
WAITPOINT_INTERPOSED int mtx_timedlock(mtx_t* __restrict mutex, const timespec* __restrict deadline) {
  return c11(pthread_mutex_timedlock(posix_of(mutex), deadline));
}

WAITPOINT_INTERPOSED int cnd_init(cnd_t* condition) { return c11(pthread_cond_init(posix_of(condition), nullptr)); }
WAITPOINT_INTERPOSED void cnd_destroy(cnd_t* condition) { pthread_cond_destroy(posix_of(condition)); }
WAITPOINT_INTERPOSED int cnd_signal(cnd_t* condition) { return c11(pthread_cond_signal(posix_of(condition))); }
WAITPOINT_INTERPOSED int cnd_broadcast(cnd_t* condition) { return c11(pthread_cond_broadcast(posix_of(condition))); }
WAITPOINT_INTERPOSED int cnd_wait(cnd_t* condition, mtx_t* mutex) {
  return c11(pthread_cond_wait(posix_of(condition), posix_of(mutex)));
}
WAITPOINT_INTERPOSED int cnd_timedwait(cnd_t* __restrict condition, mtx_t* __restrict mutex,
                                       const timespec* __restrict deadline) {
  return c11(pthread_cond_timedwait(posix_of(condition), posix_of(mutex), deadline));
}
