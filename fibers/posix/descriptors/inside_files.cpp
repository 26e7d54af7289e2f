// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/inside_files.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {
namespace {

constexpr int known_max = known_descriptors_max;
static_assert(known_max % 64 == 0, "the set of descriptors is whole words");
std::uint64_t inside[known_max / 64];
int words_used = 0;  // of that set

/// What this process knows of a descriptor.
struct Known {
  InsideFile* file;   // null: not asked for yet, or no pipe or socket
  short events;       // of an end of a counted pipe: POLLIN or POLLOUT
  bool is_asked_for;  // the file
  bool waited_in_vain;
  bool is_passed_on;  // to programs that are started
};
Known known[known_max];

constexpr std::size_t files_max = 1 << 16;
constexpr int page = 4096;

/// A table with open addressing, by inodes.
struct InsideFiles {
  InsideFile* table;
  std::uint32_t last_number;
};

InsideFiles* all_files() {
  return static_cast<InsideFiles*>(family::common(family::Part::inside_files, sizeof(InsideFiles)));
}

// The entry of this inode, or a free one for it; null if the table is full.
InsideFile* place_of(ino_t inode) {
  InsideFiles* const all = all_files();
  if (all != nullptr && all->table == nullptr)
    all->table = static_cast<InsideFile*>(family::take_pages(files_max * sizeof(InsideFile)));
  if (all == nullptr || all->table == nullptr) return nullptr;
  const std::size_t first = Digest::mix(inode) % files_max;
  for (std::size_t i = 0; i < files_max; ++i) {
    InsideFile& each = all->table[(first + i) % files_max];
    if (each.inode == inode || each.inode == 0) return &each;
  }
  return nullptr;
}

// 0 for other files.
ino_t inode_of(int descriptor, bool* is_pipe = nullptr) {
  struct stat status {};
  if (WAITPOINT_NEXT(fstat)(descriptor, &status) != 0) return 0;
  if (is_pipe != nullptr) *is_pipe = S_ISFIFO(status.st_mode);
  return S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode) ? status.st_ino : 0;
}

// Its file; null for other files than pipes and sockets, and if the table is full.
InsideFile* file_of(int descriptor) {
  Known& one = known[descriptor];
  if (one.is_asked_for) return one.file;
  one.is_asked_for = true;
  const ErrorNumberKept kept;
  bool is_pipe = false;
  const ino_t inode = inode_of(descriptor, &is_pipe);
  if (inode == 0) return nullptr;
  one.file = place_of(inode);
  if (one.file != nullptr && one.file->inode != inode)
    *one.file = {inode, 0, 0, 0, false, is_pipe, ++all_files()->last_number};
  return one.file;
}

template <class Visit>
void for_each_inside(Visit visit) {
  for (int word = 0; word < words_used; ++word)
    for (std::uint64_t left = inside[word]; left != 0; left &= left - 1) visit(word * 64 + __builtin_ctzll(left));
}

}  // namespace

void (*notice_stream)(int descriptor) = nullptr;

void note_inside(int descriptor, bool is) {
  if (descriptor < 0 || descriptor >= known_max) return;
  const std::uint64_t bit = std::uint64_t{1} << (descriptor % 64);
  std::uint64_t& word = inside[descriptor / 64];
  word = is ? word | bit : word & ~bit;
  known[descriptor] = {};
  if (is && words_used <= descriptor / 64) words_used = descriptor / 64 + 1;
  clear_owner(descriptor);
  if (is) note_owner(descriptor);
}

bool is_inside(int descriptor) {
  return descriptor >= 0 && descriptor < known_max && (inside[descriptor / 64] >> (descriptor % 64) & 1) != 0;
}

bool was_waited_for_in_vain(int descriptor) {
  return descriptor >= 0 && descriptor < known_max && known[descriptor].waited_in_vain;
}
void note_waited_for_in_vain(int descriptor) {
  if (descriptor >= 0 && descriptor < known_max) known[descriptor].waited_in_vain = true;
}

void note_pipe(const int (&ends)[2], int flags) {
  const ErrorNumberKept kept;
  for (const int end : ends) note_inside(end, true);
  if (!is_inside(ends[0]) || !is_inside(ends[1])) return;
  InsideFile* const file = file_of(ends[0]);
  if (file == nullptr) return;
  // The inode may be that of an earlier pipe.
  *file = {file->inode, 0, 0, 0, false, true, ++all_files()->last_number};
  if ((flags & (O_DIRECT | O_NONBLOCK)) != 0) return;
  file->is_counted = true;
  file->pages_max = WAITPOINT_NEXT(fcntl)(ends[0], F_GETPIPE_SZ) / page;
  known[ends[0]] = {file, POLLIN, true, false, false};
  known[ends[1]] = {file, POLLOUT, true, false, false};
}

void note_duplicate(int from, int made) {
  if (made < 0) return;
  note_inside(made, is_inside(from));
  if (made >= known_max || !is_inside(from)) return;
  known[made] = known[from];
  if (made <= STDERR_FILENO) notice_stream == nullptr ? note_stream(made) : notice_stream(made);
}

InsideFile* counted_pipe(int descriptor, short events) {
  if (descriptor < 0 || descriptor >= known_max) return nullptr;
  const Known& one = known[descriptor];
  return one.file != nullptr && one.file->is_counted && one.events == events ? one.file : nullptr;
}

std::size_t room_in(const InsideFile& pipe) {
  return pipe.pages < pipe.pages_max ? static_cast<std::size_t>(pipe.pages_max - pipe.pages) * page : 0;
}

void note_written(InsideFile* pipe, std::size_t bytes) {
  if (pipe == nullptr) return;
  pipe->held += static_cast<int>(bytes);
  pipe->pages += static_cast<int>((bytes + page - 1) / page);
}

void note_read(InsideFile* pipe, std::size_t bytes) {
  if (pipe == nullptr) return;
  WAITPOINT_CHECK(static_cast<std::size_t>(pipe->held) >= bytes || !pipe->is_counted,
                  "a counted pipe has given more than it held");
  pipe->held -= static_cast<int>(bytes);
  if (pipe->held == 0) pipe->pages = 0;
}

const InsideFile* pipe_inside(int descriptor) {
  if (!is_inside(descriptor)) return nullptr;
  const InsideFile* const file = file_of(descriptor);
  return file != nullptr && file->is_pipe ? file : nullptr;
}

void note_stream(int descriptor) {
  if (!is_inside(descriptor)) return;
  if (InsideFile* const file = file_of(descriptor); file != nullptr) file->is_counted = false, file->has_stream = true;
}

void end_counting(int descriptor) {
  if (descriptor < 0 || descriptor >= known_max) return;
  if (InsideFile* const file = known[descriptor].file; file != nullptr) file->is_counted = false;
}

void end_counting_of_inode(ino_t inode) {
  if (InsideFile* const file = place_of(inode); file != nullptr && file->inode == inode) file->is_counted = false;
}

void end_counting_of_all() {
  for_each_inside([](int descriptor) {
    if (InsideFile* const file = file_of(descriptor); file != nullptr) file->is_counted = false;
  });
}

bool may_have_unnoticed_output() {
  bool may = false;
  for_each_inside([&may](int descriptor) {
    const InsideFile* const file = file_of(descriptor);
    may = may || (file != nullptr && file->has_stream);
  });
  return may;
}

bool has_unnoticed_output() {
  bool any = false;
  for_each_inside([&any](int descriptor) {
    InsideFile* const file = file_of(descriptor);
    int bytes = 0;
    if (file == nullptr || !file->has_stream || WAITPOINT_NEXT(ioctl)(descriptor, FIONREAD, &bytes) != 0) return;
    any = any || file->held != bytes;
    file->held = bytes;
  });
  return any;
}

void note_passed_on(int descriptor) {
  if (is_inside(descriptor)) known[descriptor].is_passed_on = true;
}

void note_start(bool is_native) {
  const ErrorNumberKept kept;
  for_each_inside([&](int descriptor) {
    if (!is_native) return void(file_of(descriptor));
    const bool is_kept = (WAITPOINT_NEXT(fcntl)(descriptor, F_GETFD) & FD_CLOEXEC) == 0;
    if (!is_kept && !known[descriptor].is_passed_on) return;
    end_counting(descriptor);
    note_inside(descriptor, false);
  });
}

void note_received(int descriptor) {
  const ErrorNumberKept kept;
  const ino_t inode = inode_of(descriptor);
  InsideFile* const file = inode != 0 ? place_of(inode) : nullptr;
  if (file == nullptr || file->inode != inode) return;
  note_inside(descriptor, true);
  if (descriptor >= known_max) return;
  const int mode = WAITPOINT_NEXT(fcntl)(descriptor, F_GETFL) & O_ACCMODE;
  known[descriptor] = {file, static_cast<short>(mode == O_RDONLY ? POLLIN : POLLOUT), true, false, false};
}

void inherit_inside() {
  constexpr int most = 1024;
  for (int descriptor = 0; descriptor < most; ++descriptor) note_received(descriptor);
}

}  // namespace waitpoint::posix
