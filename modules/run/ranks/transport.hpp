// SPDX-License-Identifier: BSD-3-Clause
// The connection of a run's ranks, its processes. All calls are collective: every rank makes them in the same
// order.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::run {

class Transport {
 public:
  /// Called about ten times a second while other ranks are waited for, with the seconds so far of this wait. May throw,
  /// which ends the wait: then the transport cannot be used any more.
  using Waiting = std::function<void(double seconds)>;

  virtual ~Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

  virtual int rank() const = 0;
  /// At least 2.
  virtual int ranks() const = 0;
  /// The blocks of all ranks, in their order, this one's included. The views are valid until the next call.
  virtual const std::vector<std::string_view>& gather(std::string_view block, const Waiting& waiting) = 0;
  /// During a wait of the first rank's: the ranks that do not wait, too, "rank 2", as far as is known.
  virtual std::string missing() = 0;
  /// During a wait of another rank's: true if a wait of the first rank has failed, which reports it.
  virtual bool has_first_failed() = 0;
  /// The name of this rank's host.
  virtual std::string host() const = 0;

 protected:
  Transport() = default;
};

}  // namespace waitpoint::run
