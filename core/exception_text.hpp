// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

namespace waitpoint {

/// The text of an exception that model code has thrown: its what() may be null.
inline const char* exception_text(const std::exception& exception) {
  const char* const text = exception.what();
  return text != nullptr ? text : "an exception without a text";
}

}  // namespace waitpoint
