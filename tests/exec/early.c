// SPDX-License-Identifier: BSD-3-Clause
//
// Ends before main().
#include <stdlib.h>

__attribute__((constructor)) static void end(void) { abort(); }

int main(void) { return 0; }
