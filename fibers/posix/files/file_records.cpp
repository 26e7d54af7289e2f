// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/files/file_records.hpp"

#include <fcntl.h>
#include <sys/syscall.h>

#include <cerrno>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint64_t first_number = 2;

/// Shared by the processes: open addressing, at most half full.
struct FileTable {
  std::uint64_t capacity, used, last_number;
  FileRecord* records;
};

FileRecord& place_of(const FileTable& table, std::uint64_t device, std::uint64_t inode) {
  for (std::uint64_t at = Digest::mix(inode ^ Digest::mix(device));; ++at) {
    FileRecord& found = table.records[at & (table.capacity - 1)];
    if (found.number == 0 || (found.inode == inode && found.device == device)) return found;
  }
}

bool make_room(FileTable& table) {
  if (table.capacity > 2 * table.used) return true;
  FileTable larger = table;
  larger.capacity = table.capacity > 0 ? 2 * table.capacity : 1024;
  larger.records = static_cast<FileRecord*>(family::take(larger.capacity * sizeof(FileRecord)));
  if (larger.records == nullptr) return false;
  for (std::uint64_t i = 0; i < table.capacity; ++i)
    if (const FileRecord& each = table.records[i]; each.number != 0) place_of(larger, each.device, each.inode) = each;
  if (table.records != nullptr) family::give(table.records);
  table = larger;
  return true;
}

statx_timestamp to_date(std::int64_t ns) {
  const timespec date = to_timespec(ns);
  statx_timestamp result{};
  result.tv_sec = date.tv_sec;
  result.tv_nsec = static_cast<std::uint32_t>(date.tv_nsec);
  return result;
}

// Null without memory.
FileRecord* record_of(std::uint64_t device, std::uint64_t inode, std::int64_t born_ns) {
  WAITPOINT_CHECK(is_simulated(), "a file is recorded that no thread of the program looks at");
  auto* const table = static_cast<FileTable*>(family::common(family::Part::files, sizeof(FileTable)));
  if (table == nullptr || !make_room(*table)) return nullptr;
  FileRecord& file = place_of(*table, device, inode);
  const bool is_new = file.number == 0,
             is_another = !is_new && born_ns != 0 && file.born_ns != 0 && born_ns != file.born_ns;
  if (is_new || is_another) {
    file = {};
    file.device = device;
    file.inode = inode;
    file.number = first_number + table->last_number++;
    table->used += is_new;
  }
  if (born_ns != 0) file.born_ns = born_ns;
  return &file;
}

std::int64_t date_of_now() { return reading_ns(CLOCK_REALTIME, kernel::local_time(*kernel::running)); }

void note_change(FileRecord& file, const struct statx& state) {
  const std::int64_t changed = ns_of(state.stx_ctime), modified = ns_of(state.stx_mtime);
  if (changed < family::family->began_in_system_ns || changed == file.changed_in_system_ns) return;
  file.changed_ns = date_of_now();
  if (modified != file.modified_in_system_ns) {
    // A date before the run is one that the program has given it.
    const bool is_given = modified < family::family->began_in_system_ns;
    file.modified_ns = file.accessed_ns = is_given ? modified : file.changed_ns;
  }
  file.changed_in_system_ns = changed;
  file.modified_in_system_ns = modified;
}

constexpr int descriptors_max = 65536;
bool may_be_written[descriptors_max];

void note_state_of(int descriptor) {
  struct statx state {};
  if (is_simulated() && ask_system(descriptor, "", AT_EMPTY_PATH, state) == 0 && S_ISREG(state.stx_mode) &&
      ns_of(state.stx_ctime) >= family::family->began_in_system_ns)
    look_at(state);
}

}  // namespace

int ask_system(int folder, const char* path, int flags, struct statx& state) {
  return static_cast<int>(-call_directly(SYS_statx, folder, reinterpret_cast<long>(path), flags, wanted_of_file,
                                         reinterpret_cast<long>(&state)));
}

std::uint64_t device_of(const struct statx& state) {
  return std::uint64_t{state.stx_dev_major} << 32 | state.stx_dev_minor;
}

std::uint64_t number_of(std::uint64_t device, std::uint64_t inode) {
  const FileRecord* const file = record_of(device, inode, 0);
  return file != nullptr ? file->number : 0;
}

FileRecord* look_at(const struct statx& state) {
  const std::int64_t born_ns = (state.stx_mask & STATX_BTIME) != 0 ? ns_of(state.stx_btime) : 0;
  FileRecord* const file = record_of(device_of(state), state.stx_ino, born_ns);
  if (file != nullptr) note_change(*file, state);
  return file;
}

void replace_with_own(struct statx& state) {
  const FileRecord* const file = look_at(state);
  if (file == nullptr) return;
  state.stx_ino = file->number;
  const bool is_changed = file->changed_in_system_ns != 0;
  if (is_changed) {
    state.stx_mtime = to_date(file->modified_ns);
    state.stx_ctime = to_date(file->changed_ns);
  }
  state.stx_atime = is_changed ? to_date(file->accessed_ns) : state.stx_mtime;
  if ((state.stx_mask & STATX_BTIME) != 0 && ns_of(state.stx_btime) >= family::family->began_in_system_ns)
    state.stx_btime = state.stx_mtime;
}

void note_opened(int descriptor) {
  if (!is_simulated() || descriptor < 0 || descriptor >= descriptors_max) return;
  may_be_written[descriptor] = true;
  note_state_of(descriptor);
}

void forget_files() {
  auto* const table = static_cast<FileTable*>(family::common(family::Part::files, sizeof(FileTable)));
  if (table == nullptr) return;
  if (table->records != nullptr) family::give(table->records);
  *table = {};
  family::family->began_in_system_ns = family::date_in_system_ns();
}

void note_copy(int from, int made) {
  if (from >= 0 && from < descriptors_max && made >= 0 && made < descriptors_max)
    may_be_written[made] = may_be_written[from];
}

void note_written(int descriptor) { note_state_of(descriptor); }

void note_closing_all() {
  constexpr int standard_streams = 3, looked_at = 256;
  for (int descriptor = 0; descriptor < looked_at; ++descriptor)
    if (descriptor < standard_streams || may_be_written[descriptor]) note_state_of(descriptor);
}

void note_closing(int descriptor) {
  if (descriptor < 0 || descriptor >= descriptors_max || !may_be_written[descriptor]) return;
  may_be_written[descriptor] = false;
  note_state_of(descriptor);
}

}  // namespace waitpoint::posix
