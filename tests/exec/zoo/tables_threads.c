// SPDX-License-Identifier: BSD-3-Clause
#include <stddef.h>

#include "tests/exec/zoo/zoo.h"

const struct specimen* const tables[] = {lock_free, orders, endings, robots, hard, NULL};
