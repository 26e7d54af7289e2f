// SPDX-License-Identifier: BSD-3-Clause
//
// The library that is loaded in place of the compiler's runtime for -fsanitize=thread: the runtime's functions are in
// the preloaded library. Programs that are linked with the compiler's take atexit() from it, too, which is in no other
// shared library.
extern "C" {

int __cxa_atexit(void (*function)(void*), void* argument, void* library);

__attribute__((visibility("default"))) int atexit(void (*function)()) {
  return __cxa_atexit(reinterpret_cast<void (*)(void*)>(function), nullptr, nullptr);
}
}
