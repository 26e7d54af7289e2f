/* SPDX-License-Identifier: BSD-3-Clause */
/* The codels of mast's execution task MotionTask. */
#include <math.h>

#include "mastHeader.h"

STATUS mastInit(int *report) {
  (void)report;
  SDI_F->speed = MAST_FAST;
  return OK;
}

/* The motor: the mast moves at its present speed. */
STATUS mastMove(int *report) {
  (void)report;
  SDI_F->state.height += SDI_F->state.speed * EXEC_TASK_PERIOD(MAST_MOTIONTASK_NUM);
  return OK;
}

ACTIVITY_EVENT mastRaiseStart(double *height, double *reached, int *report) {
  (void)height;
  (void)reached;
  (void)report;
  return EXEC;
}

ACTIVITY_EVENT mastRaiseMain(double *height, double *reached, int *report) {
  const double speed = SDI_F->speed == MAST_FAST ? 0.5 : 0.1;
  const double left = *height - *reached;
  (void)report;
  if (fabs(left) < speed * EXEC_TASK_PERIOD(MAST_MOTIONTASK_NUM)) {
    SDI_F->state.height = *height;
    return END;
  }
  SDI_F->state.speed = left > 0 ? speed : -speed;
  return EXEC;
}

ACTIVITY_EVENT mastRaiseEnd(double *height, double *reached, int *report) {
  MAST_MOVES_POSTER_STR moves = {0, 0};
  (void)reached;
  (void)report;
  SDI_F->state.speed = 0;
  moves.count = ++SDI_F->moves;
  moves.height = *height;
  mastMovesPosterWrite(MAST_MOVES_POSTER_ID, &moves);
  return ETHER;
}

ACTIVITY_EVENT mastRaiseInter(double *height, double *reached, int *report) {
  (void)height;
  (void)reached;
  (void)report;
  SDI_F->state.speed = 0;
  return ETHER;
}

ACTIVITY_EVENT mastWatchMain(double *above, double *height, int *report) {
  (void)report;
  *height = SDI_F->state.height;
  return *height > *above ? ETHER : EXEC;
}
