// SPDX-License-Identifier: BSD-3-Clause
// Compiled with -mavx2; called only if the processor has AVX2.
#include "world/slice/kernels.hpp"
#include "world/slice/vector_asking.hpp"
#include "world/slice/vector_culling.hpp"

namespace waitpoint::world {

constinit const Kernels kernels_avx2 = {
    "AVX2",
    &VectorCulling<4>::turn,
    &VectorCulling<4>::look,
    &VectorCulling<4>::all_nearer,
    &VectorCulling<4>::all_end_nearer,
    &VectorCulling<4>::overlap,
    &VectorCulling<4>::meet,
    &VectorAsking<4>::ask_box,
    &VectorAsking<4>::ask_disc,
    &VectorAsking<4>::ask_narrow,
};

}  // namespace waitpoint::world
