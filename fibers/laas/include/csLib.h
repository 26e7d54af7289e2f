/* SPDX-License-Identifier: BSD-3-Clause */
/* Servers and clients. A server executes requests by functions per type, and replies; a client sends requests, and
 * takes their intermediate and final replies. csMboxInit() comes first in each task. Time-outs are in ticks; 0 is
 * without limit. */
#ifndef WAITPOINT_LAAS_CSLIB_H
#define WAITPOINT_LAAS_CSLIB_H

#include "fibers/laas/include/gcomLib.h"

#define NMAX_RQST_TYPE 25
#define SERV_NMAX_RQST_ID 20
#define CLIENT_NMAX_RQST_ID 20

#define M_csLib 512
#define S_csLib_NOT_A_SERV H2_ENCODE_ERR(M_csLib, 0)
#define S_csLib_INVALID_RQST_TYPE H2_ENCODE_ERR(M_csLib, 1)
#define S_csLib_TOO_MANY_RQST_IDS H2_ENCODE_ERR(M_csLib, 2)
#define S_csLib_BAD_RQST_ID H2_ENCODE_ERR(M_csLib, 3)
#define S_csLib_BAD_REPLY_BILAN H2_ENCODE_ERR(M_csLib, 4)
#define S_csLib_NOT_A_CLIENT H2_ENCODE_ERR(M_csLib, 5)
#define S_csLib_BAD_INTERMED_FLAG H2_ENCODE_ERR(M_csLib, 6)
#define S_csLib_BAD_BLOCK_TYPE H2_ENCODE_ERR(M_csLib, 7)

typedef struct CS_SERV CS_SERV, *SERV_ID;
typedef struct CS_CLIENT CS_CLIENT, *CLIENT_ID;
/* Executes the request with that number. */
typedef void (*CSSERVFUNC)(SERV_ID, int);

#ifdef __cplusplus
extern "C" {
#endif

STATUS csMboxInit(const char* mboxBaseName, int rcvMboxSize, int replyMboxSize);
STATUS csMboxUpdate(int rcvMboxSize, int replyMboxSize);
/* Wait for requests and replies, RCV_MBOX and REPLY_MBOX, or look: those that came; 0 at the time-out. */
int csMboxWait(int timeout, int mboxMask);
int csMboxStatus(int mask);
STATUS csMboxEnd(void);

STATUS csServInit(int maxRqstDataSize, int maxReplyDataSize, SERV_ID* pServId);
STATUS csServInitN(int maxRqstDataSize, int maxReplyDataSize, int nbRqstFunc, SERV_ID* pServId);
STATUS csServFuncInstall(SERV_ID servId, int rqstType, CSSERVFUNC rqstFunc);
/* Waits for a request and calls its type's function; without one, replies S_csLib_INVALID_RQST_TYPE. */
STATUS csServRqstExec(SERV_ID servId);
/* The input of the request that is being executed. */
STATUS csServRqstParamsGet(SERV_ID servId, int rqstId, char* rqstDataAdrs, int rqstDataSize, GCOM_CODINGFUNC decodFunc);
/* Sends an INTERMED_REPLY, whose report is OK, or the FINAL_REPLY, which frees the request's number. */
STATUS csServReplySend(SERV_ID servId, int rqstId, int replyType, int replyBilan, char* replyDataAdrs,
                       int replyDataSize, GCOM_CODINGFUNC codFunc);
STATUS csServRqstIdFree(SERV_ID servId, int rqstId);
STATUS csServEnd(SERV_ID servId);

/* A client of the server whose mailbox has that name. */
STATUS csClientInit(const char* servMboxName, int maxRqstSize, int maxIntermedReplySize, int maxFinalReplySize,
                    CLIENT_ID* pClientId);
/* Sends a request, without waiting; `intermedFlag` says whether an intermediate reply will come. */
STATUS csClientRqstSend(CLIENT_ID clientId, int rqstType, char* rqstDataAdrs, int rqstDataSize, GCOM_CODINGFUNC codFunc,
                        BOOL intermedFlag, int intermedReplyTout, int finalReplyTout, int* pRqstId);
/* Takes replies, after waiting as `block` says: the request's state. A final reply frees its number; its report, if not
 * OK, becomes the caller's error code, with ERROR. */
int csClientReplyRcv(CLIENT_ID clientId, int rqstId, int block, char* intermedReplyDataAdrs, int intermedReplyDataSize,
                     GCOM_CODINGFUNC intermedReplyDecodFunc, char* finalReplyDataAdrs, int finalReplyDataSize,
                     GCOM_CODINGFUNC finalReplyDecodFunc);
/* Frees a request whose replies will not come: see gcomSendIdFree(). */
int csClientRqstIdFree(CLIENT_ID clientId, int rqstId);
STATUS csClientEnd(CLIENT_ID clientId);

#ifdef __cplusplus
}
#endif

#endif
