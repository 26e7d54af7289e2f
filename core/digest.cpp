// SPDX-License-Identifier: BSD-3-Clause
#include "core/digest.hpp"

#include <cstdio>

namespace waitpoint {

void Digest::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  for (std::size_t at = 0; at < text.size(); at += 8) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < 8 && at + i < text.size(); ++i)
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[at + i])) << (8 * i);
    add(word);
  }
}

std::string to_string(const Digest& digest) {
  char text[24];
  std::snprintf(text, sizeof text, "wp1:%016llx", static_cast<unsigned long long>(digest.value()));
  return text;
}

}  // namespace waitpoint
