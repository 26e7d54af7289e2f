// SPDX-License-Identifier: BSD-3-Clause
#include "tests/modules/on_threads.hpp"

namespace waitpoint {

void on_threads(const std::function<void()>& body) { body(); }

}  // namespace waitpoint
