// SPDX-License-Identifier: BSD-3-Clause
// Actions that are requested more often than needed: questions to the program, tables that follow the cursor.

/**
 * A function that has the action done at most once in a while, and never before the last time has ended, if that takes longer. A
 * wish that comes meanwhile is fulfilled afterwards.
 */
function seldom(milliseconds, action) {
  let busy = false,
    wanted = false,
    last = -Infinity;
  return async function wish() {
    wanted = true;
    if (busy) return;
    busy = true;
    try {
      while (wanted) {
        await new Promise((resolve) => setTimeout(resolve, Math.max(0, last + milliseconds - performance.now())));
        wanted = false;
        await action();
        last = performance.now();
      }
    } finally {
      busy = false;
    }
  };
}
