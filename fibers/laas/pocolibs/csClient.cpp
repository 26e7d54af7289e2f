// SPDX-License-Identifier: BSD-3-Clause
// csLib's clients. Their records remain until the end of the run, so that calls on an ended one are noticed.
#include <array>
#include <deque>

#include "fibers/laas/include/csLib.h"
#include "fibers/laas/portLib.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

using waitpoint::laas::fail;

struct SentRequest {
  bool taken = false;
  bool has_intermediate_reply = false;
  int send_id = 0;
  LETTER_ID intermediate = nullptr;
  LETTER_ID final = nullptr;
};

struct CS_CLIENT {
  bool asks = true;
  MBOX_ID server = 0;
  LETTER_ID request = nullptr;
  std::array<SentRequest, CLIENT_NMAX_RQST_ID> requests;
};

namespace {

struct Clients : waitpoint::sync::RobotState {
  explicit Clients(waitpoint::kernel::Robot&) {}
  std::deque<CS_CLIENT> all;
};

bool is_client(CLIENT_ID client) {
  if (client != nullptr && client->asks) return true;
  errnoSet(S_csLib_NOT_A_CLIENT);
  return false;
}

// A request that has not got its final reply; null, with the caller's error code, for another number.
SentRequest* find(CLIENT_ID client, int id) {
  if (!is_client(client)) return nullptr;
  const bool is_number = id >= 0 && id < CLIENT_NMAX_RQST_ID;
  if (is_number && client->requests[static_cast<std::size_t>(id)].taken)
    return &client->requests[static_cast<std::size_t>(id)];
  errnoSet(S_csLib_BAD_RQST_ID);
  return nullptr;
}

// A request's state, after waiting as `block` says.
int await(const SentRequest& request, int block) {
  if (block < NO_BLOCK || block > BLOCK_ON_FINAL_REPLY) return fail(S_csLib_BAD_BLOCK_TYPE);
  const int state = gcomReplyStatus(request.send_id);
  const bool waits_for_first = state == WAITING_INTERMED_REPLY, waits_for_last = state == WAITING_FINAL_REPLY;
  if (block == BLOCK_ON_INTERMED_REPLY && waits_for_first) return gcomReplyWait(request.send_id, INTERMED_REPLY);
  if (block == BLOCK_ON_FINAL_REPLY && (waits_for_first || waits_for_last))
    return gcomReplyWait(request.send_id, FINAL_REPLY);
  return state;
}

}  // namespace

STATUS csClientInit(const char* servMboxName, int maxRqstSize, int maxIntermedReplySize, int maxFinalReplySize,
                    CLIENT_ID* pClientId) {
  MBOX_ID server = 0;
  if (gcomMboxFind(servMboxName, &server) != OK) return ERROR;
  CS_CLIENT& client = waitpoint::sync::state_of<Clients>(*waitpoint::sync::running_task().robot).all.emplace_back();
  client.server = server;
  gcomLetterAlloc(maxRqstSize, &client.request);
  for (SentRequest& request : client.requests) {
    if (maxIntermedReplySize != 0) gcomLetterAlloc(maxIntermedReplySize, &request.intermediate);
    gcomLetterAlloc(maxFinalReplySize, &request.final);
  }
  *pClientId = &client;
  return OK;
}

STATUS csClientRqstSend(CLIENT_ID clientId, int rqstType, char* rqstDataAdrs, int rqstDataSize, GCOM_CODINGFUNC codFunc,
                        BOOL intermedFlag, int intermedReplyTout, int finalReplyTout, int* pRqstId) {
  if (!is_client(clientId)) return ERROR;
  int id = 0;
  while (id < CLIENT_NMAX_RQST_ID && clientId->requests[static_cast<std::size_t>(id)].taken) ++id;
  if (id == CLIENT_NMAX_RQST_ID) return fail(S_csLib_TOO_MANY_RQST_IDS);
  if (intermedFlag != TRUE && intermedFlag != FALSE) return fail(S_csLib_BAD_INTERMED_FLAG);
  SentRequest& request = clientId->requests[static_cast<std::size_t>(id)];
  request.has_intermediate_reply = intermedFlag == TRUE;
  if (gcomLetterWrite(clientId->request, rqstType, rqstDataAdrs, rqstDataSize, codFunc) != OK) return ERROR;
  const LETTER_ID intermediate = request.has_intermediate_reply ? request.intermediate : nullptr;
  if (gcomLetterSend(clientId->server, clientId->request, intermediate, request.final, NO_BLOCK, &request.send_id,
                     intermedReplyTout, finalReplyTout) == ERROR)
    return ERROR;
  request.taken = true;
  *pRqstId = id;
  return OK;
}

int csClientReplyRcv(CLIENT_ID clientId, int rqstId, int block, char* intermedReplyDataAdrs, int intermedReplyDataSize,
                     GCOM_CODINGFUNC intermedReplyDecodFunc, char* finalReplyDataAdrs, int finalReplyDataSize,
                     GCOM_CODINGFUNC finalReplyDecodFunc) {
  SentRequest* const request = find(clientId, rqstId);
  if (request == nullptr) return ERROR;
  const int state = await(*request, block);
  if (state == WAITING_FINAL_REPLY && request->has_intermediate_reply)
    return gcomLetterRead(request->intermediate, intermedReplyDataAdrs, intermedReplyDataSize,
                          intermedReplyDecodFunc) == ERROR
               ? ERROR
               : state;
  if (state != FINAL_REPLY_OK) return state;
  request->taken = false;
  if (gcomLetterRead(request->final, finalReplyDataAdrs, finalReplyDataSize, finalReplyDecodFunc) == ERROR)
    return ERROR;
  const int report = gcomLetterType(request->final);
  return report == OK ? state : fail(report);
}

int csClientRqstIdFree(CLIENT_ID clientId, int rqstId) {
  SentRequest* const request = find(clientId, rqstId);
  if (request == nullptr || gcomSendIdFree(request->send_id) != OK) return ERROR;
  request->taken = false;
  return OK;
}

STATUS csClientEnd(CLIENT_ID clientId) {
  if (!is_client(clientId)) return ERROR;
  gcomLetterDiscard(clientId->request);
  for (const SentRequest& request : clientId->requests) {
    if (request.intermediate != nullptr) gcomLetterDiscard(request.intermediate);
    gcomLetterDiscard(request.final);
  }
  clientId->asks = false;
  return OK;
}
