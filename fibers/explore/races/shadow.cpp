// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/races/shadow.hpp"

#include <algorithm>

namespace waitpoint::races {

Cell& Shadow::new_cell(std::uint64_t word) {
  Page*& page = pages_[word / words_per_page];
  if (page == nullptr) page = static_cast<Page*>(page_memory_.take(sizeof(Page)));
  page->run = run_;
  const std::uint32_t index = cells_.add();
  page->cells[word % words_per_page] = index;
  return cells_[index] = Cell{word, nullptr, no_more, 0, 0, false, false, false, {}};
}

void Shadow::forget(const void* low, std::size_t size) {
  if (size == 0 || cells_.size() == 0) return;
  const std::uint64_t first = reinterpret_cast<std::uint64_t>(low) / 8;
  const std::uint64_t last = (reinterpret_cast<std::uint64_t>(low) + size - 1) / 8;
  for (std::uint64_t number = first / words_per_page; number <= last / words_per_page; ++number) {
    Page* const* found = pages_.find(number);
    if (found == nullptr || (*found)->run != run_) continue;
    const std::uint64_t from = std::max(first, number * words_per_page);
    const std::uint64_t to = std::min(last, number * words_per_page + words_per_page - 1);
    for (std::uint64_t word = from; word <= to; ++word) {
      const std::uint32_t index = (*found)->cells[word % words_per_page];
      if (index < cells_.size() && cells_[index].word == word) cells_[index].word = 0;
    }
  }
}

}  // namespace waitpoint::races
