// SPDX-License-Identifier: BSD-3-Clause
// The memory orders of atomic operations, as compilers number them (__ATOMIC_RELAXED ...). Consume counts as acquire.
#pragma once

namespace waitpoint::races {

constexpr bool acquires(int order) { return order != __ATOMIC_RELAXED && order != __ATOMIC_RELEASE; }
constexpr bool releases(int order) {
  return order == __ATOMIC_RELEASE || order == __ATOMIC_ACQ_REL || order == __ATOMIC_SEQ_CST;
}
/// True if the operation is in the single total order of these, S.
constexpr bool is_seq_cst(int order) { return order == __ATOMIC_SEQ_CST; }

}  // namespace waitpoint::races
