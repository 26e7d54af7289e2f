/* SPDX-License-Identifier: BSD-3-Clause */
/* Mailboxes: messages to a task, each with its sender's mailbox, in the order of their arrival. Sending never waits.
 *
 * A mailbox of n bytes is pocolibs' ring buffer: a message takes its bytes, 8, and 1 to 4 up to a multiple of 4. A
 * time-out of 0 ticks waits for ever. Calls on a closed mailbox are S_mboxLib_MBOX_CLOSED. */
#ifndef WAITPOINT_LAAS_MBOXLIB_H
#define WAITPOINT_LAAS_MBOXLIB_H

#include "fibers/laas/include/portLib.h"

typedef int MBOX_ID;

/* Codes of mboxIoctl(). */
#define FIO_NBYTES 1
#define FIO_NMSGS 2
#define FIO_GETNAME 3
#define FIO_FLUSH 4
#define FIO_SIZE 5

/* For mboxPause(). */
#define ALL_MBOX 0

#define M_h2rngLib 501
#define S_h2rngLib_ILLEGAL_NBYTES H2_ENCODE_ERR(M_h2rngLib, 0)
#define S_h2rngLib_SMALL_BUF H2_ENCODE_ERR(M_h2rngLib, 6)

#define M_mboxLib 508
#define S_mboxLib_MBOX_CLOSED H2_ENCODE_ERR(M_mboxLib, 0)
#define S_mboxLib_NOT_OWNER H2_ENCODE_ERR(M_mboxLib, 1)
#define S_mboxLib_BAD_IOCTL_CODE H2_ENCODE_ERR(M_mboxLib, 2)
#define S_mboxLib_MBOX_FULL H2_ENCODE_ERR(M_mboxLib, 3)
#define S_mboxLib_NAME_IN_USE H2_ENCODE_ERR(M_mboxLib, 4)
#define S_mboxLib_TOO_BIG H2_ENCODE_ERR(M_mboxLib, 5)
#define S_mboxLib_SMALL_BLOCK H2_ENCODE_ERR(M_mboxLib, 6)
#define S_mboxLib_SHORT_MESSAGE H2_ENCODE_ERR(M_mboxLib, 7)

#ifdef __cplusplus
extern "C" {
#endif

/* Makes the calling task known by its name: call this first in each task with mailboxes. `procName` is unused. */
STATUS mboxInit(const char* procName);
/* Deletes a task's mailboxes, 0 being the caller's. */
STATUS mboxEnd(long taskId);
/* A mailbox of the caller, with room for `size` bytes. */
STATUS mboxCreate(const char* name, int size, MBOX_ID* pMboxId);
/* Only larger: a smaller size is S_h2rngLib_ILLEGAL_NBYTES. */
STATUS mboxResize(MBOX_ID mboxId, int size);
STATUS mboxDelete(MBOX_ID mboxId);
STATUS mboxFind(const char* name, MBOX_ID* pMboxId);
/* FIO_NBYTES, FIO_NMSGS, FIO_SIZE: an int; FIO_GETNAME: a text; FIO_FLUSH: discards all messages. */
STATUS mboxIoctl(MBOX_ID mboxId, int codeFunc, void* pArg);
/* TRUE once there is a message; for ALL_MBOX in any mailbox of the caller, whose events are discarded. FALSE at the
 * time-out. */
BOOL mboxPause(MBOX_ID mboxId, int timeout);
/* Waits for a message and takes it: its length; 0 at the time-out. One that does not fit is S_h2rngLib_SMALL_BUF, and
 * empties the mailbox, as in pocolibs. */
int mboxRcv(MBOX_ID mboxId, MBOX_ID* pFromId, char* buf, int maxbytes, int timeout);
/* S_mboxLib_MBOX_FULL without room. The owner gets an event. */
STATUS mboxSend(MBOX_ID toId, MBOX_ID fromId, char* buf, int nbytes);
/* Discards the first message, if any. */
STATUS mboxSkip(MBOX_ID mboxId);
/* Copies the beginning of the first message, which remains: the number of bytes; 0 if there is none. */
int mboxSpy(MBOX_ID mboxId, MBOX_ID* pFromId, int* pNbytes, char* buf, int maxbytes);
/* Logs all mailboxes. */
void mboxShow(void);

#ifdef __cplusplus
}
#endif

#endif
