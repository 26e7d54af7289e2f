// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/pocolibs/library_errors.hpp"

#include "fibers/laas/include/commonStructLib.h"
#include "fibers/laas/include/csLib.h"
#include "fibers/laas/include/h2devLib.h"
#include "fibers/laas/include/h2evnLib.h"
#include "fibers/laas/include/h2timerLib.h"
#include "fibers/laas/include/posterLib.h"
#include "fibers/laas/include/smObjLib.h"
#include "fibers/laas/include/symLib.h"
#include "fibers/laas/include/wdLib.h"

namespace waitpoint::laas {
namespace {

#define ERROR_OF(library, name) \
  { #name, H2_DECODE_ERR(S_##library##_##name) }

constexpr H2_ERROR portLib_errors[] = {
    ERROR_OF(portLib, NO_MEMORY),      ERROR_OF(portLib, NO_SUCH_TASK),    ERROR_OF(portLib, NOT_IN_A_TASK),
    ERROR_OF(portLib, INVALID_TASKID), ERROR_OF(portLib, NOT_IMPLEMENTED),
};
constexpr H2_ERROR semLib_errors[] = {
    ERROR_OF(semLib, TOO_MANY_SEM), ERROR_OF(semLib, ALLOC_ERROR),   ERROR_OF(semLib, NOT_A_SEM),
    ERROR_OF(semLib, TIMEOUT),      ERROR_OF(semLib, RESOURCE_BUSY),
};
constexpr H2_ERROR symLib_errors[] = {
    ERROR_OF(symLib, SYMBOL_NOT_FOUND),
    ERROR_OF(symLib, NOT_IMPLEMENTED),
};
constexpr H2_ERROR wdLib_errors[] = {
    ERROR_OF(wdLib, ID_ERROR),
    ERROR_OF(wdLib, NOT_ENOUGH_MEMORY),
};
constexpr H2_ERROR smObjLib_errors[] = {
    ERROR_OF(smObjLib, SHMGET_ERROR),
    ERROR_OF(smObjLib, SHMAT_ERROR),
};
constexpr H2_ERROR h2rngLib_errors[] = {
    ERROR_OF(h2rngLib, ILLEGAL_NBYTES),
    ERROR_OF(h2rngLib, SMALL_BUF),
};
constexpr H2_ERROR h2semLib_errors[] = {
    ERROR_OF(h2semLib, TOO_MANY_SEM),    ERROR_OF(h2semLib, ALLOC_ERROR),  ERROR_OF(h2semLib, NOT_A_SEM),
    ERROR_OF(h2semLib, TIMEOUT),         ERROR_OF(h2semLib, BAD_SEM_TYPE), ERROR_OF(h2semLib, PERMISSION_DENIED),
    ERROR_OF(h2semLib, NOT_IMPLEMENTED),
};
constexpr H2_ERROR h2timerLib_errors[] = {
    ERROR_OF(h2timerLib, TIMER_NOT_INIT),    ERROR_OF(h2timerLib, BAD_DELAY),
    ERROR_OF(h2timerLib, TOO_MUCH_TIMERS),   ERROR_OF(h2timerLib, STOPPED_TIMER),
    ERROR_OF(h2timerLib, NOT_STOPPED_TIMER), ERROR_OF(h2timerLib, BAD_PERIOD),
};
constexpr H2_ERROR h2devLib_errors[] = {
    ERROR_OF(h2devLib, BAD_DEVICE_TYPE),  ERROR_OF(h2devLib, DUPLICATE_DEVICE_NAME),
    ERROR_OF(h2devLib, TOO_MANY_DEVICES), ERROR_OF(h2devLib, FIND_DEVICE_TIMEOUT),
    ERROR_OF(h2devLib, NOT_OWNER),        ERROR_OF(h2devLib, NOT_INITIALIZED),
    ERROR_OF(h2devLib, BAD_HOME_DIR),     ERROR_OF(h2devLib, FULL),
    ERROR_OF(h2devLib, BAD_PARAMETERS),   ERROR_OF(h2devLib, NOT_FOUND),
};
constexpr H2_ERROR commonStructLib_errors[] = {
    ERROR_OF(commonStructLib, ISNT_COMMON_STRUCT),
};
constexpr H2_ERROR h2evnLib_errors[] = {
    ERROR_OF(h2evnLib, BAD_TASK_ID),
};
constexpr H2_ERROR mboxLib_errors[] = {
    ERROR_OF(mboxLib, MBOX_CLOSED), ERROR_OF(mboxLib, NOT_OWNER),     ERROR_OF(mboxLib, BAD_IOCTL_CODE),
    ERROR_OF(mboxLib, MBOX_FULL),   ERROR_OF(mboxLib, NAME_IN_USE),   ERROR_OF(mboxLib, TOO_BIG),
    ERROR_OF(mboxLib, SMALL_BLOCK), ERROR_OF(mboxLib, SHORT_MESSAGE),
};
constexpr H2_ERROR posterLib_errors[] = {
    ERROR_OF(posterLib, POSTER_CLOSED),  ERROR_OF(posterLib, NOT_OWNER),  ERROR_OF(posterLib, EMPTY_POSTER),
    ERROR_OF(posterLib, BAD_IOCTL_CODE), ERROR_OF(posterLib, BAD_OP),     ERROR_OF(posterLib, DUPLICATE_POSTER),
    ERROR_OF(posterLib, MALLOC_ERROR),   ERROR_OF(posterLib, BAD_FORMAT),
};
constexpr H2_ERROR gcomLib_errors[] = {
    ERROR_OF(gcomLib, ERR_MBOX_MASK),     ERROR_OF(gcomLib, NOT_A_LETTER),     ERROR_OF(gcomLib, SMALL_LETTER),
    ERROR_OF(gcomLib, SMALL_DATA_STR),    ERROR_OF(gcomLib, TOO_MANY_SENDS),   ERROR_OF(gcomLib, ERR_SEND_ID),
    ERROR_OF(gcomLib, TOO_MANY_LETTERS),  ERROR_OF(gcomLib, LETTER_NOT_OWNER), ERROR_OF(gcomLib, INVALID_BLOCK_MODE),
    ERROR_OF(gcomLib, REPLY_LETTER_TYPE), ERROR_OF(gcomLib, MALLOC_FAILED),
};
constexpr H2_ERROR csLib_errors[] = {
    ERROR_OF(csLib, NOT_A_SERV),        ERROR_OF(csLib, INVALID_RQST_TYPE), ERROR_OF(csLib, TOO_MANY_RQST_IDS),
    ERROR_OF(csLib, BAD_RQST_ID),       ERROR_OF(csLib, BAD_REPLY_BILAN),   ERROR_OF(csLib, NOT_A_CLIENT),
    ERROR_OF(csLib, BAD_INTERMED_FLAG), ERROR_OF(csLib, BAD_BLOCK_TYPE),
};

#undef ERROR_OF

constexpr LibraryErrors libraries[] = {
    {M_portLib, "portLib", portLib_errors},
    {M_semLib, "semLib", semLib_errors},
    {M_symLib, "symLib", symLib_errors},
    {M_wdLib, "wdLib", wdLib_errors},
    {M_smObjLib, "smObjLib", smObjLib_errors},
    {M_h2rngLib, "h2rngLib", h2rngLib_errors},
    {M_h2semLib, "h2semLib", h2semLib_errors},
    {M_h2timerLib, "h2timerLib", h2timerLib_errors},
    {M_h2devLib, "h2devLib", h2devLib_errors},
    {M_commonStructLib, "commonStructLib", commonStructLib_errors},
    {M_h2evnLib, "h2evnLib", h2evnLib_errors},
    {M_mboxLib, "mboxLib", mboxLib_errors},
    {M_posterLib, "posterLib", posterLib_errors},
    {M_gcomLib, "gcomLib", gcomLib_errors},
    {M_csLib, "csLib", csLib_errors},
};

}  // namespace

std::span<const LibraryErrors> library_errors() { return libraries; }

}  // namespace waitpoint::laas
