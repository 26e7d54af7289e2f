// SPDX-License-Identifier: BSD-3-Clause
//
// Leaves a child behind that waits forever.
#include <unistd.h>

int main(void) {
  if (fork() == 0)
    for (;;) pause();
  return 0;
}
