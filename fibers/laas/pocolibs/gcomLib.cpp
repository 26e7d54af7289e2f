// SPDX-License-Identifier: BSD-3-Clause
// gcomLib's mailboxes, letters sent, and replies.
#include <string>

#include "fibers/laas/pocolibs/letters.hpp"
#include "fibers/laas/pocolibs/sends.hpp"
#include "fibers/laas/ticks.hpp"

namespace laas = waitpoint::laas;
using laas::Correspondence;
using laas::fail;
using laas::is_letter;
using laas::own_correspondence;
using laas::Send;

namespace {

char* text_of(LETTER_ID letter) { return reinterpret_cast<char*>(letter->pHdr); }
int bytes_of(LETTER_ID letter) { return letter->pHdr->dataSize + static_cast<int>(sizeof(LETTER_HDR)); }

// The ticks since the clock's start; 0 without a clock, when nothing has a time-out.
std::int64_t now() { return laas::Ticks::here().running() ? laas::Ticks::here().now() : 0; }

// Waits until a sent letter's intermediate reply, or the final one, has come or cannot come in time: its state.
int await(Correspondence& own, Send& send, bool final) {
  for (;;) {
    own.take_replies();
    const int state = send.check();
    if (state == FINAL_REPLY_OK) send.state = FREE;
    if (state != WAITING_INTERMED_REPLY && (!final || state != WAITING_FINAL_REPLY)) return state;
    if (mboxPause(own.replies, send.ticks_left()) == ERROR) return ERROR;
  }
}

}  // namespace

STATUS gcomInit(const char* procName, int rcvMboxSize, int replyMboxSize) {
  if (mboxInit(procName) == ERROR) return ERROR;
  Correspondence& own = own_correspondence();
  own = {};
  if (rcvMboxSize != 0 && mboxCreate(procName, rcvMboxSize, &own.received) == ERROR) return ERROR;
  if (replyMboxSize == 0 || mboxCreate((std::string(procName) + "R").c_str(), replyMboxSize, &own.replies) == OK)
    return OK;
  const int error = laas::errnoGet();
  if (own.received != 0) mboxDelete(own.received);
  return fail(error);
}

STATUS gcomUpdate(int rcvMboxSize, int replyMboxSize) {
  const Correspondence& own = own_correspondence();
  if (rcvMboxSize > 0 && mboxResize(own.received, rcvMboxSize) != OK) return ERROR;
  return replyMboxSize > 0 ? mboxResize(own.replies, replyMboxSize) : OK;
}

STATUS gcomEnd() {
  own_correspondence() = {};
  return mboxEnd(0);
}

STATUS gcomMboxFind(const char* procName, MBOX_ID* pMboxId) { return mboxFind(procName, pMboxId); }

STATUS gcomMboxName(MBOX_ID mboxId, char* pName) { return mboxIoctl(mboxId, FIO_GETNAME, pName); }

void gcomMboxShow() { mboxShow(); }

int gcomMboxStatus(int mask) {
  if (mask < RCV_MBOX || mask > (RCV_MBOX | REPLY_MBOX)) return fail(S_gcomLib_ERR_MBOX_MASK);
  const Correspondence& own = own_correspondence();
  int with_messages = 0;
  for (const auto& [bit, mailbox] : {std::pair(RCV_MBOX, own.received), std::pair(REPLY_MBOX, own.replies)}) {
    int bytes = 0;
    if ((mask & bit) == 0) continue;
    if (mboxIoctl(mailbox, FIO_NBYTES, &bytes) == ERROR) return ERROR;
    if (bytes != 0) with_messages |= bit;
  }
  return with_messages;
}

int gcomMboxPause(int timeout, int mask) {
  const Correspondence& own = own_correspondence();
  if (mask == RCV_MBOX || mask == REPLY_MBOX) {
    const BOOL came = mboxPause(mask == RCV_MBOX ? own.received : own.replies, timeout);
    return came == TRUE ? mask : came;
  }
  if (mask != (RCV_MBOX | REPLY_MBOX)) return fail(S_gcomLib_ERR_MBOX_MASK);
  return mboxPause(ALL_MBOX, timeout) == ERROR ? ERROR : gcomMboxStatus(mask);
}

int gcomLetterSend(MBOX_ID mboxId, LETTER_ID sendLetter, LETTER_ID intermedReplyLetter, LETTER_ID finalReplyLetter,
                   int block, int* pSendId, int intermedReplyTout, int finalReplyTout) {
  if (block < NO_BLOCK || block > BLOCK_ON_FINAL_REPLY ||
      (block == BLOCK_ON_INTERMED_REPLY && intermedReplyLetter == nullptr))
    return fail(S_gcomLib_INVALID_BLOCK_MODE);
  if (!is_letter(sendLetter) || !is_letter(finalReplyLetter)) return ERROR;
  if (intermedReplyLetter != nullptr && !is_letter(intermedReplyLetter)) return ERROR;
  Correspondence& own = own_correspondence();
  int id = 0;
  while (id < MAX_SEND && own.sends[static_cast<std::size_t>(id)].state != FREE) ++id;
  if (id == MAX_SEND) return fail(S_gcomLib_TOO_MANY_SENDS);
  Send& send = own.sends[static_cast<std::size_t>(id)];
  send.state = intermedReplyLetter != nullptr ? WAITING_INTERMED_REPLY : WAITING_FINAL_REPLY;
  send.sent = now();
  send.intermediate_timeout = intermedReplyTout;
  send.final_timeout = finalReplyTout;
  send.intermediate = intermedReplyLetter;
  send.final = finalReplyLetter;
  sendLetter->pHdr->sendId = id;
  if (mboxSend(mboxId, own.replies, text_of(sendLetter), bytes_of(sendLetter)) != OK) {
    send.state = FREE;
    return ERROR;
  }
  if (block != BLOCK_ON_FINAL_REPLY) *pSendId = id;
  return block == NO_BLOCK ? send.state : await(own, send, block == BLOCK_ON_FINAL_REPLY);
}

BOOL gcomLetterRcv(LETTER_ID letter, MBOX_ID* pOrigMboxId, int* pSendId, int timeout) {
  if (!is_letter(letter)) return ERROR;
  const int bytes = mboxRcv(own_correspondence().received, pOrigMboxId, text_of(letter), letter->size, timeout);
  if (bytes <= 0) return bytes;
  *pSendId = letter->pHdr->sendId;
  return TRUE;
}

STATUS gcomLetterReply(MBOX_ID mboxId, int sendId, int replyLetterType, LETTER_ID letterReply) {
  if (replyLetterType != INTERMED_REPLY && replyLetterType != FINAL_REPLY) return fail(S_gcomLib_REPLY_LETTER_TYPE);
  if (!is_letter(letterReply)) return ERROR;
  letterReply->pHdr->sendId = sendId;
  letterReply->pHdr->type = replyLetterType;
  return mboxSend(mboxId, own_correspondence().received, text_of(letterReply), bytes_of(letterReply));
}

int gcomReplyStatus(int sendId) {
  Correspondence& own = own_correspondence();
  Send* const send = own.find(sendId);
  if (send == nullptr) return ERROR;
  own.take_replies();
  const int state = send->check();
  if (state == FINAL_REPLY_OK) send->state = FREE;
  return state;
}

int gcomReplyWait(int sendId, int replyLetterType) {
  Correspondence& own = own_correspondence();
  Send* const send = own.find(sendId);
  if (send == nullptr) return ERROR;
  if (replyLetterType != INTERMED_REPLY && replyLetterType != FINAL_REPLY) return fail(S_gcomLib_REPLY_LETTER_TYPE);
  return await(own, *send, replyLetterType == FINAL_REPLY);
}

STATUS gcomSendIdFree(int sendId) {
  Send* const send = own_correspondence().find(sendId);
  if (send == nullptr) return ERROR;
  send->state = FREE;
  return OK;
}

int gcomSendIdList(int* pList, int maxList) {
  const Correspondence& own = own_correspondence();
  int count = 0;
  for (int id = 0; id < MAX_SEND && count < maxList; ++id)
    if (own.sends[static_cast<std::size_t>(id)].state != FREE) pList[count++] = id;
  return count;
}

void gcomReplyLetterBySendId(int sendId, LETTER_ID* pIntermedReplyLetter, LETTER_ID* pFinalReplyLetter) {
  const Send* const send = own_correspondence().find(sendId);
  if (send == nullptr) return;
  if (pIntermedReplyLetter != nullptr) *pIntermedReplyLetter = send->intermediate;
  if (pFinalReplyLetter != nullptr) *pFinalReplyLetter = send->final;
}

void gcomSelect(char* sendIdTable) {
  Correspondence& own = own_correspondence();
  own.take_replies();
  for (int id = 0; id < MAX_SEND; ++id)
    if (sendIdTable[id] == 1) sendIdTable[id] = static_cast<char>(own.sends[static_cast<std::size_t>(id)].check());
}
