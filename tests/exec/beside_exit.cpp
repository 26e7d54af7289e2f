// SPDX-License-Identifier: BSD-3-Clause
//
// A thread that crashes, beside a process that ends: beside_exit WAY. It crashes only if it comes after WAY has begun.
#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <cstring>

namespace {

volatile bool has_begun_to_end = false;

struct Table {
  ~Table() { is_destroyed = true; }
  static volatile bool is_destroyed;
};
volatile bool Table::is_destroyed = false;
Table table;

void crash() { __builtin_trap(); }

void* read_flag(void*) {
  if (has_begun_to_end) crash();
  return nullptr;
}
void* read_table(void*) {
  if (Table::is_destroyed) crash();
  return nullptr;
}
void* crash_at_once(void*) {
  crash();
  return nullptr;
}
void* do_nothing(void*) { return nullptr; }

void leave(int) { _exit(0); }
void begin_to_end() { has_begun_to_end = true; }

}  // namespace

int main(int, char** words) {
  const auto is = [&](const char* way) { return std::strcmp(words[1], way) == 0; };
  pthread_t thread;
  pthread_create(&thread, nullptr,
                 is("statics")   ? read_table
                 : is("return")  ? crash_at_once
                 : is("nothing") ? do_nothing
                                 : read_flag,
                 nullptr);
  if (is("return") || is("statics") || is("nothing")) return 0;
  if (is("atexit")) {
    atexit(begin_to_end);
    exit(0);
  }
  if (is("detach")) {
    has_begun_to_end = true;
    pthread_detach(thread);
    has_begun_to_end = false;
    _exit(0);
  }
  has_begun_to_end = true;
  if (is("quick_exit")) quick_exit(0);
  if (is("abort")) {
    signal(SIGABRT, leave);
    abort();
  }
  if (is("exit")) exit(0);
  _exit(0);
}
