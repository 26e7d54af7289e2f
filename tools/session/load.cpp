// SPDX-License-Identifier: BSD-3-Clause
//
// waitpoint-load FILE ARGUMENTS: runs a program that is built as a shared object, as a process of its own.
#include <dlfcn.h>

#include <cstdio>
#include <string>

namespace {

using Main = int (*)(int, char**, char**);

int refuse(const char* file, const char* reason) {
  std::fprintf(stderr, "waitpoint: exec: %s %s\n", file, reason);
  return 125;
}

}  // namespace

// This main() is not exported: dlsym() finds the object's.
int main(int argc, char** argv, char** environment) {
  if (argc < 2) return refuse("waitpoint-load", "expects a shared object");
  // The dynamic linker would look for a name without a '/' in its own folders.
  std::string file = argv[1];
  if (file.find('/') == std::string::npos) file.insert(0, "./");
  void* const object = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (object == nullptr) return refuse("a program cannot be loaded:", dlerror());
  void* const found = dlsym(object, "main");
  if (found == nullptr) return refuse(argv[1], "has no main() that others see");
  return reinterpret_cast<Main>(found)(argc - 1, argv + 1, environment);
}
