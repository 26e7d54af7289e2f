// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/kernels.hpp"

#include "core/instructions.hpp"

namespace waitpoint::world {

std::vector<const Kernels*> all_kernels() {
  std::vector<const Kernels*> all = {&kernels_portable};
#if WAITPOINT_X86_64 || WAITPOINT_AARCH64
  all.push_back(&kernels_baseline);
#endif
#if WAITPOINT_X86_64
  if (__builtin_cpu_supports("avx2")) all.push_back(&kernels_avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    all.push_back(&kernels_avx512);
#endif
  return all;
}

const Kernels& kernels() {
  static const Kernels& widest = *all_kernels().back();
  return widest;
}

}  // namespace waitpoint::world
