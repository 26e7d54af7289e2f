// SPDX-License-Identifier: BSD-3-Clause
// csLib's servers. Their records remain until the end of the run, so that calls on an ended one are noticed.
#include <array>
#include <deque>
#include <vector>

#include "fibers/laas/include/csLib.h"
#include "fibers/laas/portLib.hpp"
#include "fibers/sync/blocking.hpp"
#include "fibers/sync/robot_state.hpp"

using waitpoint::laas::fail;

// The requests that wait for their final replies.
struct ReceivedRequest {
  bool taken = false;
  MBOX_ID client = 0;
  int send_id = 0;
};

struct CS_SERV {
  bool serves = true;
  LETTER_ID request = nullptr;
  LETTER_ID reply = nullptr;
  int executing = -1;
  std::vector<CSSERVFUNC> functions;
  std::array<ReceivedRequest, SERV_NMAX_RQST_ID> requests;
};

namespace {

struct Servers : waitpoint::sync::RobotState {
  explicit Servers(waitpoint::kernel::Robot&) {}
  std::deque<CS_SERV> all;
};

bool is_server(SERV_ID server) {
  if (server != nullptr && server->serves) return true;
  errnoSet(S_csLib_NOT_A_SERV);
  return false;
}

// A request that waits for its reply; null, with the caller's error code, for another number.
ReceivedRequest* find(SERV_ID server, int id) {
  if (!is_server(server)) return nullptr;
  const bool is_number = id >= 0 && id < SERV_NMAX_RQST_ID;
  if (is_number && server->requests[static_cast<std::size_t>(id)].taken)
    return &server->requests[static_cast<std::size_t>(id)];
  errnoSet(S_csLib_BAD_RQST_ID);
  return nullptr;
}

}  // namespace

STATUS csServInit(int maxRqstDataSize, int maxReplyDataSize, SERV_ID* pServId) {
  return csServInitN(maxRqstDataSize, maxReplyDataSize, NMAX_RQST_TYPE, pServId);
}

STATUS csServInitN(int maxRqstDataSize, int maxReplyDataSize, int nbRqstFunc, SERV_ID* pServId) {
  CS_SERV& server = waitpoint::sync::state_of<Servers>(*waitpoint::sync::running_task().robot).all.emplace_back();
  server.functions.resize(static_cast<std::size_t>(MAX(nbRqstFunc, 0)));
  gcomLetterAlloc(maxRqstDataSize, &server.request);
  gcomLetterAlloc(maxReplyDataSize, &server.reply);
  *pServId = &server;
  return OK;
}

STATUS csServFuncInstall(SERV_ID servId, int rqstType, CSSERVFUNC rqstFunc) {
  if (!is_server(servId)) return ERROR;
  if (rqstType < 0 || static_cast<std::size_t>(rqstType) >= servId->functions.size())
    return fail(S_csLib_INVALID_RQST_TYPE);
  servId->functions[static_cast<std::size_t>(rqstType)] = rqstFunc;
  return OK;
}

STATUS csServRqstExec(SERV_ID servId) {
  if (!is_server(servId)) return ERROR;
  int id = 0;
  while (id < SERV_NMAX_RQST_ID && servId->requests[static_cast<std::size_t>(id)].taken) ++id;
  if (id == SERV_NMAX_RQST_ID) return fail(S_csLib_TOO_MANY_RQST_IDS);
  ReceivedRequest& request = servId->requests[static_cast<std::size_t>(id)];
  if (gcomLetterRcv(servId->request, &request.client, &request.send_id, 0) != TRUE) return ERROR;
  request.taken = true;
  const int type = gcomLetterType(servId->request);
  const bool is_type = type >= 0 && static_cast<std::size_t>(type) < servId->functions.size();
  const CSSERVFUNC function = is_type ? servId->functions[static_cast<std::size_t>(type)] : nullptr;
  if (function == nullptr)
    return csServReplySend(servId, id, FINAL_REPLY, S_csLib_INVALID_RQST_TYPE, nullptr, 0, nullptr);
  servId->executing = id;
  function(servId, id);
  return OK;
}

STATUS csServRqstParamsGet(SERV_ID servId, int rqstId, char* rqstDataAdrs, int rqstDataSize,
                           GCOM_CODINGFUNC decodFunc) {
  if (find(servId, rqstId) == nullptr) return ERROR;
  if (rqstId != servId->executing) return fail(S_csLib_BAD_RQST_ID);
  return gcomLetterRead(servId->request, rqstDataAdrs, rqstDataSize, decodFunc) == ERROR ? ERROR : OK;
}

STATUS csServReplySend(SERV_ID servId, int rqstId, int replyType, int replyBilan, char* replyDataAdrs,
                       int replyDataSize, GCOM_CODINGFUNC codFunc) {
  ReceivedRequest* const request = find(servId, rqstId);
  if (request == nullptr) return ERROR;
  if (replyType == INTERMED_REPLY && replyBilan != OK) return fail(S_csLib_BAD_REPLY_BILAN);
  if (gcomLetterWrite(servId->reply, replyBilan, replyDataAdrs, replyDataSize, codFunc) != OK) return ERROR;
  if (gcomLetterReply(request->client, request->send_id, replyType, servId->reply) != OK) return ERROR;
  if (replyType == FINAL_REPLY) request->taken = false;
  return OK;
}

STATUS csServRqstIdFree(SERV_ID servId, int rqstId) {
  ReceivedRequest* const request = find(servId, rqstId);
  if (request == nullptr) return ERROR;
  request->taken = false;
  return OK;
}

STATUS csServEnd(SERV_ID servId) {
  if (!is_server(servId)) return ERROR;
  gcomLetterDiscard(servId->request);
  gcomLetterDiscard(servId->reply);
  servId->serves = false;
  return OK;
}
