// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/keys.hpp"
#include "fibers/posix/program/state_calls.hpp"

#include <limits.h>
#include <pthread.h>
#include <threads.h>

#include "core/error.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

using Destructor = void (*)(void*);

struct Key {
  bool in_use;
  Destructor destructor;
};
Key keys[PTHREAD_KEYS_MAX];
static_assert(sizeof(tss_t) == sizeof(pthread_key_t));
unsigned keys_end = 0;  // one past the greatest key made

int make(pthread_key_t* key, Destructor destructor) {
  before_call<"pthread_key_create">(changing(place::threads));
  const int error = WAITPOINT_NEXT(pthread_key_create)(key, nullptr);
  if (error != 0 || *key >= PTHREAD_KEYS_MAX) return error;
  keys[*key] = {true, destructor};
  if (*key >= keys_end) keys_end = *key + 1;
  return 0;
}

}  // namespace

void destroy_values_of_keys() {
  WAITPOINT_CHECK(keys_end <= PTHREAD_KEYS_MAX, "the table of keys has more than it has room for");
  bool found = true;
  for (int round = 0; round < PTHREAD_DESTRUCTOR_ITERATIONS && found; ++round) {
    found = false;
    for (pthread_key_t key = 0; key < keys_end; ++key) {
      if (!keys[key].in_use) continue;
      void* const value = pthread_getspecific(key);
      if (value == nullptr) continue;
      pthread_setspecific(key, nullptr);
      if (keys[key].destructor == nullptr) continue;
      found = true;
      keys[key].destructor(value);
    }
  }
}

}  // namespace waitpoint::posix

using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int pthread_key_create(pthread_key_t* key, void (*destructor)(void*)) noexcept {
  return make(key, destructor);
}
WAITPOINT_INTERPOSED int __pthread_key_create(pthread_key_t* key, void (*destructor)(void*)) noexcept {
  return make(key, destructor);
}
WAITPOINT_INTERPOSED int tss_create(tss_t* key, tss_dtor_t destructor) { return make(key, destructor) == 0 ? 0 : 2; }

WAITPOINT_INTERPOSED int pthread_key_delete(pthread_key_t key) noexcept {
  before_call<"pthread_key_delete">(changing(place::threads));
  if (key < PTHREAD_KEYS_MAX) keys[key] = {};
  return WAITPOINT_NEXT(pthread_key_delete)(key);
}
WAITPOINT_INTERPOSED void tss_delete(tss_t key) { pthread_key_delete(key); }
