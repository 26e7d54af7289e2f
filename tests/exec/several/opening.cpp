// SPDX-License-Identifier: BSD-3-Clause
//
// opening NAME ROUNDS: opens itself, a library that it is linked to, and one beside its file; prints NAME and what it
// counts there, once in a millisecond.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/exec/several/counts.hpp"

static int of_program = 0;
extern "C" [[gnu::visibility("default")]] void count_in_program() { ++of_program; }

static int (*count)() = nullptr;

static bool opens() {
  Dl_info self{};
  if (dladdr(reinterpret_cast<void*>(&opens), &self) == 0) return false;
  const std::string file = self.dli_fname;
  void* const plugin = dlopen((file.substr(0, file.rfind('/')) + "/plugin.so").c_str(), RTLD_LAZY);
  void* const lower = dlopen("liblower.so", RTLD_NOW);
  void* const program = dlopen(nullptr, RTLD_NOW);
  if (plugin == nullptr || lower == nullptr || program == nullptr) return false;
  count = reinterpret_cast<int (*)()>(dlsym(plugin, "count_in_plugin"));
  reinterpret_cast<void (*)(const char*)>(dlsym(lower, "_Z4notePKc"))("noted");
  reinterpret_cast<void (*)()>(dlsym(program, "count_in_program"))();
  return count != nullptr;
}

int main(int argc, char** argv) {
  if (!opens()) {
    std::printf("%s\n", dlerror());
    return 1;
  }
  int plugin = 0;
  for (int i = argc > 2 ? std::atoi(argv[2]) : 0; i > 0; --i, usleep(1000)) plugin = count();
  std::printf("%s:%s, %d %d %d\n", argv[1], order(), plugin, of_lower, of_program);
  return 0;
}
