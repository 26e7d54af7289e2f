// SPDX-License-Identifier: BSD-3-Clause
// Recognises that a thread spins: without a simulated call, it reads the same values at the same places again and
// again. Only another thread can end such a loop. Counts accesses only, so that it is the same in each run.
#pragma once

#include <cstdint>
#include <cstring>

#include "fibers/posix/traps/memory_peek.hpp"

namespace waitpoint::posix {

class Spinning {
 public:
  /// The thread with this id is about to read, as its event number `event`; earlier calls may be another thread's.
  /// True if the others are to have a turn.
  bool reads(int thread, std::uint64_t event, std::uint64_t place, std::uint64_t address, std::size_t bytes) {
    if (thread != thread_ || event != event_) *this = {};
    thread_ = thread;
    if (++since_call_ % long_loop == 0) return true;
    Read& read = read_at(place, address);
    const bool is_known = read.place == place && read.address == address;
    std::uint64_t value = 0;
    const bool has_value = is_known && peek(address, &value, bytes < sizeof value ? bytes : sizeof value);
    const bool is_same = has_value && read.has_value && read.value == value;
    // The first value is looked at when the place is met again.
    if (!is_same && (!is_known || read.has_value)) repeats_ = 0;
    read = {place, address, value, has_value};
    return is_same && ++repeats_ > repeats_max;
  }
  /// After it: the thread's next event is that number.
  void passed(std::uint64_t event) { event_ = event; }

 private:
  struct Read {
    std::uint64_t place, address, value;
    bool has_value;
  };
  static constexpr std::uint32_t repeats_max = 16, long_loop = 256;
  static constexpr std::size_t reads_kept = 4;

  Read& read_at(std::uint64_t place, std::uint64_t address) {
    for (Read& read : reads_)
      if (read.place == place && read.address == address) return read;
    return reads_[next_++ % reads_kept];
  }

  Read reads_[reads_kept] = {};
  std::uint32_t next_ = 0, repeats_ = 0, since_call_ = 0;
  int thread_ = 0;
  std::uint64_t event_ = 0;
};

}  // namespace waitpoint::posix
