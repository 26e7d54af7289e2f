// SPDX-License-Identifier: BSD-3-Clause
// Huge pages for the heap. A crowd's objects are scattered over the heap; with pages of 4 KiB address translation costs
// as much as the memory accesses themselves, with huge pages the TLB holds all translations.
#pragma once

namespace waitpoint::run {

/// Asks the system to move the memory allocated so far to huge pages. Addresses do not change. No effect where this is
/// unsupported or disabled (Linux before 6.1, transparent huge pages switched off).
void put_heap_on_large_pages();

}  // namespace waitpoint::run
