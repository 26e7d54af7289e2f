// SPDX-License-Identifier: BSD-3-Clause
//
// Leaves a child behind, who waits for ever.
#include <unistd.h>

int main(void) {
  if (fork() == 0)
    for (;;) pause();
  return 0;
}
