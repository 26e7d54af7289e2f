// SPDX-License-Identifier: BSD-3-Clause
#include "tools/view/server/token.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "core/error.hpp"

namespace waitpoint::tools::view {

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  WAITPOINT_CHECK(getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
                  "the system has no random bytes");
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace waitpoint::tools::view
