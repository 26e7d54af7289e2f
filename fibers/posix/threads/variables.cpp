// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/variables.hpp"

#include <cstdlib>
#include <new>

extern "C" void __call_tls_dtors();  // of the C library

namespace waitpoint::posix {

struct ThreadDestructor {
  void (*function)(void*);
  void* argument;
  ThreadDestructor* before;
};

bool add_destructor(void (*function)(void*), void* argument) {
  void* const memory = std::malloc(sizeof(ThreadDestructor));
  if (memory == nullptr) return false;
  Thread& thread = this_thread();
  thread.last_destructor = new (memory) ThreadDestructor{function, argument, thread.last_destructor};
  return true;
}

// A destructor may make another variable, whose destructor is called next.
void destroy_variables() {
  Thread& thread = this_thread();
  while (thread.last_destructor != nullptr) {
    const ThreadDestructor destructor = *thread.last_destructor;
    std::free(thread.last_destructor);
    thread.last_destructor = destructor.before;
    destructor.function(destructor.argument);
  }
  __call_tls_dtors();
}

void forget_destructors(Thread& thread) {
  while (thread.last_destructor != nullptr) {
    ThreadDestructor* const destructor = thread.last_destructor;
    thread.last_destructor = destructor->before;
    std::free(destructor);
  }
}

}  // namespace waitpoint::posix
