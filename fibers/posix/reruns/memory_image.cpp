// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reruns/memory_image.hpp"

#include <fcntl.h>
#include <sys/syscall.h>

#include <algorithm>
#include <iterator>

#include "fibers/posix/base/direct_call.hpp"

namespace waitpoint::posix {
namespace {

// The library's function might be the program's own.
void copy_page(char* to, const char* from) {
  std::size_t words = page_bytes / sizeof(std::uint64_t);
  asm volatile("rep movsq" : "+D"(to), "+S"(from), "+c"(words) : : "memory");
}

// False if it does not fit.
bool read_text(const char* path, char* text, std::size_t room) {
  const long file = call_directly(SYS_openat, AT_FDCWD, reinterpret_cast<long>(path), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  std::size_t size = 0;
  long got = 0;
  do {
    got = call_directly(SYS_read, file, reinterpret_cast<long>(text + size), static_cast<long>(room - 1 - size));
    if (got > 0) size += static_cast<std::size_t>(got);
  } while (got > 0);
  call_directly(SYS_close, file);
  text[size] = '\0';
  return got == 0 && size < room - 1;
}

std::uintptr_t number_at(const char*& text) {
  std::uintptr_t number = 0;
  for (;; ++text) {
    const char c = *text;
    if (c >= '0' && c <= '9')
      number = number * 16 + static_cast<std::uintptr_t>(c - '0');
    else if (c >= 'a' && c <= 'f')
      number = number * 16 + static_cast<std::uintptr_t>(c - 'a' + 10);
    else
      return number;
  }
}

}  // namespace

template <class Visit>
bool MemoryImage::for_each_page(const Range& range, const PageMap& map, Visit visit) {
  for (std::size_t number = 0; number < range.pages.count();) {
    const std::size_t count = std::min(std::size(entries_), range.pages.count() - number);
    if (!map.read(range.pages.begin + number * page_bytes, entries_, count)) return false;
    for (std::size_t i = 0; i < count; ++i) visit(number++, entries_[i]);
  }
  return true;
}

bool MemoryImage::add(Pages pages, bool is_of_file, bool grows_down, std::span<const Pages> excluded) {
  for (const Pages& each : excluded)
    if (pages.begin < each.end && each.begin < pages.end) return true;
  constexpr std::uintptr_t growth = 64 * page_bytes;
  if (grows_down) pages.begin -= growth;
  const std::size_t count = pages.count();
  if (count_ == ranges_max || marks_ + count > pages_max) return false;
  ranges_[count_++] = {pages, next_, marks_, is_of_file};
  next_ += count * page_bytes;
  marks_ += count;
  return reinterpret_cast<std::uintptr_t>(next_) <= room_.end;
}

// Lines such as "7ffff7fc1000-7ffff7fc5000 rw-p 00000000 00:00 0      [stack]".
bool MemoryImage::read_mappings(std::span<const Pages> excluded) {
  if (!read_text("/proc/self/maps", text_, sizeof text_)) return false;
  for (const char* at = text_; *at != '\0';) {
    Pages pages{};
    pages.begin = number_at(at);
    pages.end = number_at(++at);
    const bool is_private_and_written = at[2] == 'w' && at[4] == 'p';
    const char* end = at;
    while (*end != '\n' && *end != '\0') ++end;
    const char* name = std::find_if(at, end, [](char c) { return c == '/' || c == '['; });
    if (is_private_and_written && !add(pages, name != end && *name == '/', end - name >= 7 && name[1] == 's', excluded))
      return false;
    at = *end == '\n' ? end + 1 : end;
  }
  return count_ > 0;
}

bool MemoryImage::take(std::span<const Pages> excluded, Pages room) {
  count_ = marks_ = 0;
  room_ = room;
  next_ = reinterpret_cast<char*>(room.begin);
  if (!read_mappings(excluded)) return false;
  const PageMap map;
  return std::all_of(ranges_, ranges_ + count_, [&](const Range& range) {
    return for_each_page(range, map, [this, &range](std::size_t number, PageMap::Entry entry) {
      const bool is_own = entry.is_present() && !entry.is_of_file();
      was_there_[range.first_mark + number] = is_own || entry.is_swapped();
      if (range.is_of_file || entry.is_present() || entry.is_swapped())
        copy_page(range.copy + number * page_bytes, reinterpret_cast<char*>(range.pages.begin) + number * page_bytes);
    });
  });
}

bool MemoryImage::has_anonymous(const Pages& pages) const {
  return std::any_of(ranges_, ranges_ + count_, [&pages](const Range& range) {
    return !range.is_of_file && pages.begin >= range.pages.begin && pages.end <= range.pages.end;
  });
}

bool MemoryImage::restore(const PageMap& map) {
  written_count_ = 0;
  const bool is_told = std::all_of(ranges_, ranges_ + count_, [&](const Range& range) {
    return for_each_page(range, map, [this, &range](std::size_t number, PageMap::Entry entry) {
      const bool is_written = entry.is_present() && !entry.is_of_file() && entry.is_exclusive();
      const bool is_gone = !entry.is_present() && was_there_[range.first_mark + number];
      if (is_written || is_gone || entry.is_swapped())
        written_[written_count_++] = {reinterpret_cast<char*>(range.pages.begin) + number * page_bytes,
                                      range.copy + number * page_bytes};
    });
  });
  if (is_told) restore_again();
  return is_told;
}

void MemoryImage::restore_again() const {
  for (const Written* each = written_; each != written_ + written_count_; ++each) copy_page(each->page, each->copy);
}

}  // namespace waitpoint::posix
