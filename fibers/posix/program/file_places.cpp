// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/program/file_places.hpp"

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/digest.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/interposed.hpp"

namespace waitpoint::posix {
namespace {

long address_word(const void* pointer) { return reinterpret_cast<long>(pointer); }

struct FileState {
  bool exists = false;
  struct stat of {};

  bool is_link() const { return exists && S_ISLNK(of.st_mode); }
  bool is_folder() const { return exists && S_ISDIR(of.st_mode); }
  bool has_other_names() const { return exists && !is_folder() && of.st_nlink > 1; }
};

FileState file_state_of(const char* path) {
  FileState state;
  state.exists =
      call_directly(SYS_newfstatat, AT_FDCWD, address_word(path), address_word(&state.of), AT_SYMLINK_NOFOLLOW) == 0;
  return state;
}

Places place_of_path(std::string_view path, char of = 'f') {
  std::uint64_t hash = static_cast<unsigned char>(of);
  for (const char letter : path) hash = Digest::mix(hash + static_cast<unsigned char>(letter));
  return place::file(hash);
}

/// A text of some length, without memory of the heap.
struct PathText {
  char text[2 * PATH_MAX + 2] = "";

  void set(std::string_view to) { text[to.copy(text, sizeof text - 1)] = '\0'; }
  void add(std::string_view name) {
    std::size_t size = view().size();
    if (size == 0 || text[size - 1] != '/') text[size++] = '/';
    text[size + name.copy(text + size, sizeof text - 1 - size)] = '\0';
  }
  std::string_view view() const { return text; }
  std::string_view parent() const {
    const std::size_t end = view().rfind('/');
    return view().substr(0, end == 0 ? 1 : end);
  }
};

bool read_link_of_descriptor(int descriptor, PathText& to) {
  char link[40];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const long size = call_directly(SYS_readlink, address_word(link), address_word(to.text), PATH_MAX);
  to.text[size > 0 ? size : 0] = '\0';
  return size > 0;
}

void follow_links(PathText& path) {
  char whole[PATH_MAX];
  if (WAITPOINT_NEXT(realpath)(path.text, whole) != nullptr) path.set(whole);
}

// The name, absolute, in a folder without links, as far as it exists.
PathText canonical(int folder, const char* path) {
  PathText whole;
  if (path[0] != '/') {
    if (folder != AT_FDCWD)
      read_link_of_descriptor(folder, whole);
    else if (call_directly(SYS_getcwd, address_word(whole.text), PATH_MAX) <= 0)
      whole.text[0] = '\0';
  }
  std::string_view name = path;
  while (name.size() > 1 && name.back() == '/') name.remove_suffix(1);
  if (!name.empty()) whole.add(name);
  const std::size_t slash = whole.view().rfind('/');
  const PathText last = [&] {
    PathText of;
    of.set(whole.view().substr(slash + 1));
    return of;
  }();
  if (last.view() == "." || last.view() == ".." || last.view().empty()) {
    follow_links(whole);
    return whole;
  }
  whole.set(whole.parent());
  follow_links(whole);
  whole.add(last.view());
  return whole;
}

// The folders that lead to it.
Places folders_above(std::string_view path) {
  Places places = 0;
  for (std::size_t slash = path.find('/', 1); slash != path.npos; slash = path.find('/', slash + 1))
    places |= place_of_path(path.substr(0, slash));
  return places;
}

Places list_of(std::string_view folder) { return place_of_path(folder, 'l'); }

struct Name {
  PathText path;
  FileState state;
  Places places = 0;  ///< its own, and that of the file that it leads to
  Places above = 0;   ///< of what is passed on the way

  Name(int folder, const char* given, bool follows_link)
      : path(canonical(folder, given)), state(file_state_of(path.text)) {
    places = place_of_path(path.view());
    above = folders_above(path.view());
    if (given[0] != '/') above |= folder == AT_FDCWD ? place::directory : place::descriptors;
    if (state.has_other_names()) places = place::files;
    if (!follows_link || !state.is_link()) return;
    PathText target = path;
    follow_links(target);
    above |= places | folders_above(target.view());
    places = file_state_of(target.text).has_other_names() || target.view() == path.view()
                 ? place::files
                 : place_of_path(target.view());
    path = target;
  }
};

bool leads_somewhere(const char* path) { return path != nullptr && can_be_read(path) && *path != '\0'; }

}  // namespace

Places file_at(int descriptor) {
  FileState state;
  if (call_directly(SYS_fstat, descriptor, address_word(&state.of)) != 0) return 0;
  state.exists = true;
  if (!S_ISREG(state.of.st_mode) && !S_ISDIR(state.of.st_mode)) return place::channels;
  PathText path;
  if (state.has_other_names() || !read_link_of_descriptor(descriptor, path)) return place::files;
  constexpr std::string_view removed = " (deleted)";
  std::string_view name = path.view();
  if (name.ends_with(removed)) name.remove_suffix(removed.size());
  return place_of_path(name);
}

EventFootprint reading_name(int folder, const char* path, bool follows_link) {
  if (path != nullptr && can_be_read(path) && *path == '\0') return reading_at(folder);
  if (!leads_somewhere(path)) return {};
  const Name name(folder, path, follows_link);
  return reading(name.places | name.above | (name.state.is_folder() ? list_of(name.path.view()) : 0));
}

EventFootprint reading_folder(int folder, const char* path) {
  if (!leads_somewhere(path)) return {};
  const Name name(folder, path, true);
  return reading(name.places | name.above | list_of(name.path.view()));
}

EventFootprint changing_stream(FILE* stream) {
  const int descriptor = fileno_unlocked(stream);
  const Places own = place::file(Digest::mix(reinterpret_cast<std::uintptr_t>(stream)));
  return reading(place::descriptors) | changing(own | (descriptor >= 0 ? file_at(descriptor) : Places{0}));
}

EventFootprint reading_entries(int descriptor) {
  PathText path;
  if (!read_link_of_descriptor(descriptor, path)) return {};
  return reading(place::descriptors | list_of(path.view())) | changing(file_at(descriptor));
}

EventFootprint changing_name(int folder, const char* path) {
  if (!leads_somewhere(path)) return {};
  const Name name(folder, path, false);
  return reading(name.above | list_of(name.path.view())) | changing(name.places | list_of(name.path.parent()));
}

EventFootprint changing_file(int folder, const char* path, bool follows_link) {
  if (path != nullptr && can_be_read(path) && *path == '\0') return changing_at(folder);
  if (!leads_somewhere(path)) return {};
  const Name name(folder, path, follows_link);
  return reading(name.above) | changing(name.places);
}

EventFootprint opening(int folder, const char* path, int flags) {
  EventFootprint footprint = changing(place::descriptors);
  if (!leads_somewhere(path)) return footprint;
  const bool follows = (flags & O_NOFOLLOW) == 0;
  const Name name(folder, path, follows);
  const bool may_make = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  if (may_make) footprint = footprint | reading(place::creation_mask);
  if (may_make && !file_state_of(name.path.text).exists)
    return footprint | reading(name.above) | changing(name.places | list_of(name.path.parent()));
  if ((flags & O_TRUNC) != 0) return footprint | reading(name.above) | changing(name.places);
  return footprint | reading(name.above | name.places | list_of(name.path.view()));
}

EventFootprint renaming(int folder, const char* path, int to_folder, const char* to) {
  if (!leads_somewhere(path) || !leads_somewhere(to)) return {};
  if (Name(folder, path, false).state.is_folder() || Name(to_folder, to, false).state.is_folder())
    return reading(place::directory) | changing(place::files);
  return changing_name(folder, path) | changing_name(to_folder, to);
}

}  // namespace waitpoint::posix
