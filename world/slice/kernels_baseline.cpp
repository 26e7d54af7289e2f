// SPDX-License-Identifier: BSD-3-Clause
// The instructions of every processor of a kind: SSE2 on x86-64, NEON on 64-bit ARM.
#include "world/slice/kernels.hpp"
#include "world/slice/vector_asking.hpp"
#include "world/slice/vector_culling.hpp"

namespace waitpoint::world {

constinit const Kernels kernels_baseline = {
    WAITPOINT_X86_64 ? "SSE2" : "NEON",
    &VectorCulling<2>::turn,
    &VectorCulling<2>::look,
    &VectorCulling<2>::all_nearer,
    &VectorCulling<2>::all_end_nearer,
    &VectorCulling<2>::overlap,
    &VectorCulling<2>::meet,
    &VectorAsking<2>::ask_box,
    &VectorAsking<2>::ask_disc,
    &VectorAsking<2>::ask_narrow,
};

}  // namespace waitpoint::world
