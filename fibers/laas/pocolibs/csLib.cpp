// SPDX-License-Identifier: BSD-3-Clause
// csLib's mailboxes: those of gcomLib.
#include "fibers/laas/include/csLib.h"

STATUS csMboxInit(const char* mboxBaseName, int rcvMboxSize, int replyMboxSize) {
  return gcomInit(mboxBaseName, rcvMboxSize, replyMboxSize);
}

STATUS csMboxUpdate(int rcvMboxSize, int replyMboxSize) { return gcomUpdate(rcvMboxSize, replyMboxSize); }

int csMboxWait(int timeout, int mboxMask) { return gcomMboxPause(timeout, mboxMask); }

int csMboxStatus(int mask) { return gcomMboxStatus(mask); }

STATUS csMboxEnd() { return gcomEnd(); }
