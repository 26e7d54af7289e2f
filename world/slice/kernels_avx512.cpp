// SPDX-License-Identifier: BSD-3-Clause
// Compiled for AVX-512 (F, BW, DQ, VL); called only if the processor has it.
#include "world/slice/kernels.hpp"
#include "world/slice/vector_asking.hpp"
#include "world/slice/vector_culling.hpp"

namespace waitpoint::world {

constinit const Kernels kernels_avx512 = {
    "AVX-512",
    &VectorCulling<8>::turn,
    &VectorCulling<8>::look,
    &VectorCulling<8>::all_nearer,
    &VectorCulling<8>::all_end_nearer,
    &VectorCulling<8>::overlap,
    &VectorCulling<8>::meet,
    &VectorAsking<8>::ask_box,
    &VectorAsking<8>::ask_disc,
    &VectorAsking<8>::ask_narrow,
};

}  // namespace waitpoint::world
