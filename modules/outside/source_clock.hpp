// SPDX-License-Identifier: BSD-3-Clause
// The dates in virtual time of a source's time stamps. A second of its clock is a second of virtual time.
//
//   own    its clock begins anywhere: lags are measured from the report with the least, whose lag is 0
//   unix   seconds since 1970 by the clock of this host, or one synchronised with it
//   run    virtual time, as the source knows it from the replies
//
// Stamps ascend. One that leaps ahead of virtual time is refused, or all after it would be in the past.
#pragma once

#include <optional>
#include <string>

#include "core/time.hpp"

namespace waitpoint::outside {

class SourceClock {
 public:
  enum class Kind { own, unix, run };

  /// The clock of that name; nothing for another.
  static std::optional<Kind> kind_of(const std::string& name);

  explicit SourceClock(Kind kind = Kind::own) : kind_(kind) {}

  /// The date of a report that is taken in at virtual time `now`, while this host's clock shows `unix_s`; or the reason
  /// to refuse it.
  struct Dated {
    double date_s = 0;
    std::string refused;
  };
  Dated date(double stamp_s, Time now, double unix_s);

 private:
  Kind kind_;
  std::optional<double> last_s_;  // stamp
  double last_now_s_ = 0;         // virtual time at which it was taken in
  double ahead_s_ = 0;            // own: of virtual time over the stamps, at the least lag
};

}  // namespace waitpoint::outside
