// SPDX-License-Identifier: BSD-3-Clause
// What a primitive does in a header is compiled with the user's code, and with what that is instrumented by. Between
// its waitpoints it works on its own state, which no other task can come in between: that is no access of the user's,
// no data race, and no switch point.
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

/// While there is one, the running task's accesses to memory count for nothing in ThreadSanitizer and in
/// explore/races. Without -fsanitize=thread it is nothing.
class Unseen {
 public:
#ifdef WAITPOINT_SEEN_BY_THREAD_SANITIZER
  Unseen() { __tsan_ignore_thread_begin(); }
  ~Unseen() { __tsan_ignore_thread_end(); }
#else
  Unseen() {}
  ~Unseen() {}
#endif
  Unseen(const Unseen&) = delete;
  Unseen& operator=(const Unseen&) = delete;
};

}  // namespace waitpoint::sync
