// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibers/laas/include/gcomLib.h"

namespace waitpoint::laas {

/// False, with the caller's error code S_gcomLib_NOT_A_LETTER, for a letter that was not allocated.
bool is_letter(LETTER_ID letter);

}  // namespace waitpoint::laas
