// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/linearizability/interval.hpp"

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

std::string running_title() { return kernel::running == nullptr ? "outside" : title_of(*kernel::running); }

bool is_unwound() { return kernel::running != nullptr && kernel::is_unwinding(*kernel::running->scheduler); }

}  // namespace waitpoint::exploration
