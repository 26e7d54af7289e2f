// SPDX-License-Identifier: BSD-3-Clause
// A place in a description or in a header that it includes, for messages: "demo.gen:12: column 7: expected ...".
#pragma once

#include <memory>
#include <string>

namespace waitpoint::description {

struct SourcePlace {
  std::shared_ptr<const std::string> file;
  int line = 0;    ///< from 1
  int column = 0;  ///< from 1, in bytes
};

/// Throws BadInput at `place`.
[[noreturn]] void reject(const SourcePlace& place, const std::string& message);

}  // namespace waitpoint::description
