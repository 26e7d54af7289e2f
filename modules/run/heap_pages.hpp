// SPDX-License-Identifier: BSD-3-Clause
// What many robots are made of lies here and there in the heap. On pages of 4 KiB finding where each page is costs as
// much as the memory itself; on large ones all of a crowd's are known to the processor.
#pragma once

namespace waitpoint::run {

/// Asks the system to put what has been allocated so far on large pages: it copies what is not there yet. Where it
/// cannot or is told not to (Linux before 6.1, transparent huge pages switched off) all stays as it is. Addresses stay
/// in any case.
void put_heap_on_large_pages();

}  // namespace waitpoint::run
