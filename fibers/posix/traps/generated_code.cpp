// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/generated_code.hpp"

#include <algorithm>
#include <cstdint>

#include "fibers/posix/traps/library_range.hpp"

namespace waitpoint::posix {
namespace {

struct CodeRange {
  std::uintptr_t begin, end;
};

// In the order of their addresses, without overlaps. If there are too many, memory is counted twice that becomes
// executable again.
constexpr std::size_t ranges_max = 1024;
CodeRange ranges[ranges_max];
std::size_t count = 0;
std::uint64_t before_run = 0;
std::uint64_t* counted_in = &before_run;

// Adds a range; returns how much of it is new.
std::uint64_t add(CodeRange range) {
  CodeRange* const end = ranges + count;
  CodeRange* const first = std::lower_bound(
      ranges, end, range.begin, [](const CodeRange& one, std::uintptr_t address) { return one.end < address; });
  CodeRange* last = first;
  std::uint64_t fresh = range.end - range.begin;
  for (; last != end && last->begin <= range.end; ++last) {
    const std::uintptr_t from = std::max(last->begin, range.begin), to = std::min(last->end, range.end);
    fresh -= to - from;
  }
  if (first != last) {
    *first = {std::min(first->begin, range.begin), std::max((last - 1)->end, range.end)};
    count = static_cast<std::size_t>(std::move(last, end, first + 1) - ranges);
  } else if (count < ranges_max) {
    std::move_backward(first, end, end + 1);
    *first = range;
    ++count;
  }
  return fresh;
}

}  // namespace

void note_executable(const void* begin, std::size_t bytes) {
  constexpr std::uintptr_t page_bytes = 4096;
  const auto from = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t to = (from + bytes + page_bytes - 1) & ~(page_bytes - 1);
  if (to <= from || range_of_library_with(begin).contains(from)) return;
  *counted_in += add({from, to});
}

void count_generated_code(std::uint64_t& total) {
  counted_in = &total;
  total += before_run;
}

}  // namespace waitpoint::posix
