// SPDX-License-Identifier: BSD-3-Clause
// The secret in a page's address.
#pragma once

#include <string>

namespace waitpoint::tools::view {

/// 128 random bits as hexadecimal digits. They reach no event.
std::string make_token();

}  // namespace waitpoint::tools::view
