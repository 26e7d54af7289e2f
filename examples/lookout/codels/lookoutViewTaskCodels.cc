// SPDX-License-Identifier: BSD-3-Clause
// The codels of lookout's execution task ViewTask. Several robots of a run have this module: what a codel keeps is in
// the internal data, SDI_F, not in variables of the file.
#include <cstring>

#include "lookoutHeader.h"
#include "mastMsgLib.h"

namespace {

ACTIVITY_EVENT begin_move(double height, int *report) {
  CLIENT_ID mast = nullptr;
  if (mastClientInit(&mast) != OK) {
    *report = S_lookout_NO_MAST;
    return ETHER;
  }
  double reached = 0;
  int answer = OK;
  const int status = mastRaiseRqstAndAck(mast, &SDI_F->request, 100, &height, &reached, &SDI_F->activity, &answer);
  if (status == WAITING_FINAL_REPLY || status == FINAL_REPLY_OK) return EXEC;
  *report = S_lookout_MAST_REFUSES;
  return ETHER;
}

// True once the mast has answered.
bool arrived() {
  CLIENT_ID mast = nullptr;
  double reached = 0;
  int answer = OK;
  mastClientInit(&mast);
  return mastRaiseReplyRcv(mast, SDI_F->request, NO_BLOCK, &reached, &SDI_F->activity, &answer) != WAITING_FINAL_REPLY;
}

}  // namespace

ACTIVITY_EVENT lookoutLookStart(double *height, LOOKOUT_VIEW *, int *report) { return begin_move(*height, report); }

ACTIVITY_EVENT lookoutLookMain(double *, LOOKOUT_VIEW *view, int *report) {
  if (!arrived()) return EXEC;
  POSTER_ID poster = nullptr;
  MAST_STATE state;                 // the first part of the poster
  MAST_STATE_POSTER_STR all;
  char name[] = "mastState";        // GenoM's name of mast.State
  if (lookoutMAST_STATEPosterFind(name, &poster) != OK || lookoutMAST_STATEPosterRead(poster, &state) != OK ||
      mastStatePosterRead(poster, &all) != OK) {
    *report = S_lookout_NO_MAST;
    return ETHER;
  }
  view->height = state.height;
  ++view->number;
  std::strcpy(view->with, all.load.name);
  return begin_move(0, report) == EXEC ? END : ETHER;
}

ACTIVITY_EVENT lookoutLookEnd(double *, LOOKOUT_VIEW *, int *) { return arrived() ? ETHER : END; }

ACTIVITY_EVENT lookoutLookInter(double *, LOOKOUT_VIEW *, int *) {
  CLIENT_ID mast = nullptr;
  int report = OK;
  mastClientInit(&mast);
  mastAbortRqstAndRcv(mast, &SDI_F->activity, &report);
  return ETHER;
}
