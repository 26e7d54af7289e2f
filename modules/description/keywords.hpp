// SPDX-License-Identifier: BSD-3-Clause
// The words of C and C++ that name nothing else: names of a description are declared in both languages.
#pragma once

#include <string_view>

namespace waitpoint::description {

/// True for the keywords of C11 and C++20.
bool is_keyword(std::string_view word);

}  // namespace waitpoint::description
