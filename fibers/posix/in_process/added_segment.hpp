// SPDX-License-Identifier: BSD-3-Clause
// A segment behind the others of an object file, for strings that the file's own table has no room for.
#pragma once

#include <cstdint>

#include "fibers/posix/in_process/object_file.hpp"

namespace waitpoint::posix {

/// It begins with the table of segments, which has one entry more than before, and so moves there.
class AddedSegment {
 public:
  /// With room for this many bytes of strings.
  AddedSegment(const ObjectFile& object, const FileBytes& bytes, std::size_t room);
  ~AddedSegment();
  AddedSegment(const AddedSegment&) = delete;
  AddedSegment& operator=(const AddedSegment&) = delete;

  /// False without memory.
  bool is_made() const { return begin_ != nullptr; }
  /// Adds a string; returns its offset from the object's table of strings.
  std::uint64_t add(const char* text);
  /// Makes the object's head refer to the segment. The bytes to be written, at `offset()` of the file, are final then.
  void finish();

  const char* begin() const { return begin_; }
  std::size_t size() const { return end_; }
  std::uint64_t offset() const { return offset_; }

 private:
  const ObjectFile& object_;
  char* begin_ = nullptr;
  std::size_t room_, end_;
  std::uint64_t offset_, address_;
};

}  // namespace waitpoint::posix
