/* SPDX-License-Identifier: BSD-3-Clause */
/* Written to the API of pocolibs: waits without limit for a letter that nobody sends. */
#include <h2initGlob.h>
#include <mboxLib.h>
#include <portLib.h>

int main(void) {
  MBOX_ID mailbox, from;
  char text[16];
  if (h2initGlob(100) != OK || mboxInit("main") != OK || mboxCreate("letters", 100, &mailbox) != OK) return 2;
  return mboxRcv(mailbox, &from, text, sizeof(text), WAIT_FOREVER);
}
