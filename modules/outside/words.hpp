// SPDX-License-Identifier: BSD-3-Clause
// Words of the lines that partners exchange, as scenario::take_word() reads them.
#pragma once

#include <string>

namespace waitpoint::outside {

/// In quotation marks if it has blanks.
inline std::string quoted_word(const std::string& word) {
  return word.find(' ') == std::string::npos ? word : '"' + word + '"';
}

}  // namespace waitpoint::outside
