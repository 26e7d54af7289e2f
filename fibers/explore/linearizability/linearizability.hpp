// SPDX-License-Identifier: BSD-3-Clause
// The options and the result of a check of a history.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>

#include "fibers/explore/linearizability/history_picture.hpp"

namespace waitpoint {

struct LinearizabilityOptions {
  std::uint64_t configurations_max = 200'000;  ///< visited by one search before it is undecided; each stores a model
};

/// As a condition it is true only if a linearization was found: EXPECT_TRUE(result) << result.
struct Linearizability {
  enum class Verdict : std::uint8_t { linearizable, not_linearizable, undecided };

  Verdict verdict = Verdict::linearizable;
  std::string key;                       ///< of the part without a linearization, if the model has keys
  exploration::HistoryPicture picture;   ///< of a history that is not linearizable, or of its part
  std::uint64_t configurations_max = 0;  ///< after which the search was given up, if undecided

  explicit operator bool() const { return verdict == Verdict::linearizable; }
  /// The picture as a document of scalable vector graphics; empty unless the history is not linearizable.
  std::string svg() const;
};

/// The first line is the same for all histories, so that a schedule that fails by it can be minimised.
std::ostream& operator<<(std::ostream& out, const Linearizability& result);

}  // namespace waitpoint
