// SPDX-License-Identifier: BSD-3-Clause
// For any processor: a quarter of a block at a time, without intrinsics.
#include "world/slice/kernels.hpp"
#include "world/slice/vector_asking.hpp"
#include "world/slice/vector_culling.hpp"

namespace waitpoint::world {

constinit const Kernels kernels_portable = {
    "portable",
    &VectorCulling<2, Instructions::portable>::turn,
    &VectorCulling<2, Instructions::portable>::look,
    &VectorCulling<2, Instructions::portable>::all_nearer,
    &VectorCulling<2, Instructions::portable>::all_end_nearer,
    &VectorCulling<2, Instructions::portable>::overlap,
    &VectorCulling<2, Instructions::portable>::meet,
    &VectorAsking<2, Instructions::portable>::ask_box,
    &VectorAsking<2, Instructions::portable>::ask_disc,
    &VectorAsking<2, Instructions::portable>::ask_narrow,
};

}  // namespace waitpoint::world
