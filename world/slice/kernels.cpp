// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/kernels.hpp"

namespace waitpoint::world {

std::vector<const Kernels*> all_kernels() {
  std::vector<const Kernels*> all = {&kernels_baseline};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) all.push_back(&kernels_avx2);
#endif
  return all;
}

const Kernels& kernels() {
  static const Kernels& widest = *all_kernels().back();
  return widest;
}

}  // namespace waitpoint::world
