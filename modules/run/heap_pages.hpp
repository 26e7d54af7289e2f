// SPDX-License-Identifier: BSD-3-Clause
// Huge pages for the heap. A crowd's objects are scattered over the heap; with pages of 4 KiB address translation costs
// as much as the memory accesses themselves, with huge pages the TLB holds all translations.
#pragma once

#include <cstddef>

namespace waitpoint::run {

/// Before the objects of a crowd are made: the heap grows at once by `bytes`, at most a gigabyte, which will be huge
/// pages at their first use, without small ones to be moved. Memory that is freed stays with the process up to as much.
/// No effect where huge pages are unsupported or switched off.
void grow_heap_on_large_pages(std::size_t bytes);

/// Asks the system to move the memory allocated so far to huge pages. Addresses do not change. No effect where this is
/// unsupported or disabled (Linux before 6.1, transparent huge pages switched off).
void put_heap_on_large_pages();

}  // namespace waitpoint::run
