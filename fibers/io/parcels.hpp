// SPDX-License-Identifier: BSD-3-Clause
// Objects under way between robots of one process, which a packet refers to by number: the data of their programs,
// whose sockets are the system's.
#pragma once

#include <cstdint>
#include <map>

namespace waitpoint::io {

class Parcels {
 public:
  using Act = void (*)(void* object);

  Parcels() = default;
  /// Drops those still under way.
  ~Parcels();
  Parcels(const Parcels&) = delete;
  Parcels& operator=(const Parcels&) = delete;

  /// Until it arrives or is dropped. Returns its number.
  std::uint64_t keep(void* object, Act arrive, Act drop);
  /// Calls `arrive`, then `drop`.
  void arrive(std::uint64_t number);
  /// Calls `drop`.
  void drop(std::uint64_t number);

 private:
  struct Parcel {
    void* object;
    Act arrive, drop;
  };
  Parcel take(std::uint64_t number);

  std::map<std::uint64_t, Parcel> under_way_;
  std::uint64_t last_ = 0;
};

}  // namespace waitpoint::io
