// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/in_process/added_segment.hpp"

#include <cstdlib>

#include "core/error.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint64_t page = 4096;

std::uint64_t to_whole_pages(std::uint64_t bytes) { return (bytes + page - 1) / page * page; }

std::uint64_t end_of_memory(const ObjectFile& object) {
  std::uint64_t end = 0;
  for (const Elf64_Phdr& part : object.parts())
    if (part.p_type == PT_LOAD && part.p_vaddr + part.p_memsz > end) end = part.p_vaddr + part.p_memsz;
  return end;
}

}  // namespace

AddedSegment::AddedSegment(const ObjectFile& object, const FileBytes& bytes, std::size_t room)
    : object_(object),
      room_(room + (object.parts().size() + 1) * sizeof(Elf64_Phdr)),
      end_((object.parts().size() + 1) * sizeof(Elf64_Phdr)),
      offset_(to_whole_pages(bytes.size())),
      address_(to_whole_pages(end_of_memory(object))) {
  begin_ = static_cast<char*>(std::calloc(room_, 1));
}

AddedSegment::~AddedSegment() { std::free(begin_); }

std::uint64_t AddedSegment::add(const char* text) {
  const std::size_t length = std::strlen(text) + 1;
  WAITPOINT_CHECK(length <= room_ - end_, "a segment has no room for a string");
  std::memcpy(begin_ + end_, text, length);
  const std::uint64_t at = address_ + end_ - object_.value(DT_STRTAB);
  end_ += length;
  return at;
}

// The dynamic linker asks that segments are in the order of their addresses.
void AddedSegment::finish() {
  auto* const table = reinterpret_cast<Elf64_Phdr*>(begin_);
  const std::span<const Elf64_Phdr> parts = object_.parts();
  std::size_t place = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].p_type == PT_LOAD) place = i + 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Elf64_Phdr& part = table[i < place ? i : i + 1];
    part = parts[i];
    if (part.p_type != PT_PHDR) continue;
    part.p_offset = offset_;
    part.p_vaddr = part.p_paddr = address_;
    part.p_filesz = part.p_memsz = (parts.size() + 1) * sizeof(Elf64_Phdr);
  }
  Elf64_Phdr& added = table[place];
  added.p_type = PT_LOAD;
  added.p_flags = PF_R;
  added.p_offset = offset_;
  added.p_vaddr = added.p_paddr = address_;
  added.p_filesz = added.p_memsz = end_;
  added.p_align = page;
  object_.head().e_phoff = offset_;
  object_.head().e_phnum = static_cast<Elf64_Half>(parts.size() + 1);
}

}  // namespace waitpoint::posix
