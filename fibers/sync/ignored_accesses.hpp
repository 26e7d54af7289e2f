// SPDX-License-Identifier: BSD-3-Clause
// The primitives' code in headers is compiled, and instrumented, with the user's code. Between its waitpoints it works
// on its own state, which no other task can touch meanwhile: these accesses must not count as the user's, as data races
// or as switch points.
#pragma once

#if defined(__SANITIZE_THREAD__)
#define WAITPOINT_SEEN_BY_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define WAITPOINT_SEEN_BY_THREAD_SANITIZER
#endif
#endif

#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
extern "C" {
void __tsan_ignore_thread_begin();
void __tsan_ignore_thread_end();
}
#endif

namespace waitpoint::sync {

/// In its scope, ThreadSanitizer and explore/races ignore the running task's accesses to memory. Empty without
/// -fsanitize=thread.
class IgnoredAccesses {
 public:
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  IgnoredAccesses() { __tsan_ignore_thread_begin(); }
  ~IgnoredAccesses() { __tsan_ignore_thread_end(); }
#else
  IgnoredAccesses() {}
  ~IgnoredAccesses() {}
#endif
  IgnoredAccesses(const IgnoredAccesses&) = delete;
  IgnoredAccesses& operator=(const IgnoredAccesses&) = delete;
};

}  // namespace waitpoint::sync
