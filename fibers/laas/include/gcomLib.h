/* SPDX-License-Identifier: BSD-3-Clause */
/* Letters with replies: a task has a mailbox for letters and one for the replies to its own. A letter may have an
 * intermediate reply and has a final one, each with a time-out in ticks since it was sent; 0 is without limit. */
#ifndef WAITPOINT_LAAS_GCOMLIB_H
#define WAITPOINT_LAAS_GCOMLIB_H

#include "fibers/laas/include/mboxLib.h"

/* Letters of a task that wait for replies. */
#define MAX_SEND 80

/* Their states. */
#define FREE 0
#define WAITING_INTERMED_REPLY 1
#define INTERMED_REPLY_TIMEOUT 2
#define WAITING_FINAL_REPLY 3
#define FINAL_REPLY_TIMEOUT 4
#define FINAL_REPLY_OK 5

/* A task's mailboxes, as bits. */
#define RCV_MBOX 1
#define REPLY_MBOX 2

#define NO_BLOCK 1
#define BLOCK_ON_INTERMED_REPLY 2
#define BLOCK_ON_FINAL_REPLY 3

/* Types of replies. */
#define INTERMED_REPLY 1
#define FINAL_REPLY 2

#define M_gcomLib 511
#define S_gcomLib_ERR_MBOX_MASK H2_ENCODE_ERR(M_gcomLib, 1)
#define S_gcomLib_NOT_A_LETTER H2_ENCODE_ERR(M_gcomLib, 2)
#define S_gcomLib_SMALL_LETTER H2_ENCODE_ERR(M_gcomLib, 3)
#define S_gcomLib_SMALL_DATA_STR H2_ENCODE_ERR(M_gcomLib, 4)
#define S_gcomLib_TOO_MANY_SENDS H2_ENCODE_ERR(M_gcomLib, 5)
#define S_gcomLib_ERR_SEND_ID H2_ENCODE_ERR(M_gcomLib, 6)
#define S_gcomLib_TOO_MANY_LETTERS H2_ENCODE_ERR(M_gcomLib, 7)
#define S_gcomLib_LETTER_NOT_OWNER H2_ENCODE_ERR(M_gcomLib, 8)
#define S_gcomLib_INVALID_BLOCK_MODE H2_ENCODE_ERR(M_gcomLib, 9)
#define S_gcomLib_REPLY_LETTER_TYPE H2_ENCODE_ERR(M_gcomLib, 10)
#define S_gcomLib_MALLOC_FAILED H2_ENCODE_ERR(M_gcomLib, 11)

/* A letter's head, before its data. */
typedef struct {
  int sendId;
  int type;     /* of a reply */
  int dataType; /* of a request, or a final reply's report */
  int dataSize;
} LETTER_HDR, *LETTER_HDR_ID;

typedef struct LETTER {
  int flagInit;
  int size; /* with the head */
  LETTER_HDR_ID pHdr;
} LETTER, *LETTER_ID;

/* Copies the first data to the second with a change of form: the number of bytes, or ERROR. */
typedef int (*GCOM_CODINGFUNC)(char*, int, char*, int);

#ifdef __cplusplus
extern "C" {
#endif

/* Makes the caller's mailboxes: `procName`, and that with an R behind for replies; none for a size of 0. */
STATUS gcomInit(const char* procName, int rcvMboxSize, int replyMboxSize);
STATUS gcomUpdate(int rcvMboxSize, int replyMboxSize);
STATUS gcomEnd(void);
STATUS gcomMboxFind(const char* procName, MBOX_ID* pMboxId);
STATUS gcomMboxName(MBOX_ID mboxId, char* pName);
void gcomMboxShow(void);
/* Wait for a message in the mailboxes of `mask`, or look: those with messages; 0 at the time-out. */
int gcomMboxPause(int timeout, int mask);
int gcomMboxStatus(int mask);

STATUS gcomLetterAlloc(int sizeLetter, LETTER_ID* pLetterId);
STATUS gcomLetterDiscard(LETTER_ID letterId);
STATUS gcomLetterWrite(LETTER_ID letterId, int dataType, char* pData, int dataSize, GCOM_CODINGFUNC codingFunc);
int gcomLetterRead(LETTER_ID letterId, char* pData, int maxDataSize, GCOM_CODINGFUNC decodingFunc);
int gcomLetterType(LETTER_ID letterId);
/* 0, as in pocolibs. */
int gcomLetterList(LETTER_ID* pList, int maxList);

/* Sends a letter, and waits as `block` says: the state. Of both time-outs, the intermediate reply's comes first. */
int gcomLetterSend(MBOX_ID mboxId, LETTER_ID sendLetter, LETTER_ID intermedReplyLetter, LETTER_ID finalReplyLetter,
                   int block, int* pSendId, int intermedReplyTout, int finalReplyTout);
/* TRUE with a letter, 0 at the time-out. */
BOOL gcomLetterRcv(LETTER_ID letter, MBOX_ID* pOrigMboxId, int* pSendId, int timeout);
STATUS gcomLetterReply(MBOX_ID mboxId, int sendId, int replyLetterType, LETTER_ID letterReply);
/* A sent letter's state; FINAL_REPLY_OK is returned once, and frees its number. */
int gcomReplyStatus(int sendId);
int gcomReplyWait(int sendId, int replyLetterType);
void gcomReplyLetterBySendId(int sendId, LETTER_ID* pIntermedReplyLetter, LETTER_ID* pFinalReplyLetter);
/* Frees a number whose replies will not come; a reply that comes nevertheless is taken for the next letter's. */
STATUS gcomSendIdFree(int sendId);
int gcomSendIdList(int* pList, int maxList);
/* Replaces each 1 of the MAX_SEND bytes by the letter's state. */
void gcomSelect(char* sendIdTable);

#ifdef __cplusplus
}
#endif

#endif
