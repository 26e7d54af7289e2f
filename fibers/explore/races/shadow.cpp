// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/shadow.hpp"

#include <algorithm>

namespace waitpoint::races {
namespace {

// Not zero for the first page of all memory.
constexpr std::uint64_t key_of(std::uint64_t page) { return page + 1; }

}  // namespace

Shadow::Page* Shadow::seek_page(std::uint64_t number) {
  Page* const* const page = pages_.find(key_of(number));
  if (page == nullptr) return nullptr;
  recent_[place_of(number)] = {number + 1, *page};
  return *page;
}

Cell& Shadow::new_cell(std::uint64_t word) {
  const std::uint64_t number = word / words_per_page;
  RecentPage& recent = recent_[place_of(number)];
  if (recent.key != number + 1) {
    Page*& page = pages_[key_of(number)];
    if (page == nullptr) page = static_cast<Page*>(page_memory_.take(sizeof(Page)));
    recent = {number + 1, page};
  }
  Page* const page = recent.page;
  if (page->run != run_) page->groups = 0;
  page->run = run_;
  page->groups |= std::uint64_t{1} << word % words_per_page / words_per_group;
  const std::uint32_t index = cells_.add();
  page->cells[word % words_per_page] = index;
  return cells_[index] = Cell{word, nullptr, no_more, no_location, 0, 0, false, false, false, false, {}};
}

void Shadow::forget(const void* low, std::size_t size) {
  if (size == 0 || cells_.size() == 0) return;
  const std::uint64_t first = reinterpret_cast<std::uint64_t>(low) / 8;
  const std::uint64_t last = (reinterpret_cast<std::uint64_t>(low) + size - 1) / 8;
  for (std::uint64_t number = first / words_per_page; number <= last / words_per_page; ++number) {
    Page* const* found = pages_.find(key_of(number));
    if (found == nullptr || (*found)->run != run_) continue;
    const std::uint64_t from = number == first / words_per_page ? first % words_per_page : 0;
    const std::uint64_t to = number == last / words_per_page ? last % words_per_page : words_per_page - 1;
    // The groups with cells in the range.
    std::uint64_t groups = (*found)->groups >> from / words_per_group << from / words_per_group;
    groups = groups << (63 - to / words_per_group) >> (63 - to / words_per_group);
    for (; groups != 0; groups &= groups - 1) {
      const std::uint64_t group = static_cast<std::uint64_t>(__builtin_ctzll(groups)) * words_per_group;
      forget(**found, number * words_per_page, std::max(from, group), std::min(to, group + words_per_group - 1));
    }
  }
}

// Forgets the words `from` up to `to` of a page, whose first word is `begin`.
void Shadow::forget(const Page& page, std::uint64_t begin, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t word = from; word <= to; ++word) {
    const std::uint32_t index = page.cells[word];
    if (index < cells_.size() && cells_[index].word == begin + word) cells_[index].word = 0;
  }
}

}  // namespace waitpoint::races
