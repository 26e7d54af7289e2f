/* SPDX-License-Identifier: BSD-3-Clause */
/* The control codels of mast: they check the inputs of requests. */
#include "mastHeader.h"

STATUS mastSetSpeedCntrl(MAST_SPEED *speed, int *report) {
  if (*speed == MAST_SLOW || *speed == MAST_FAST) return OK;
  *report = S_mast_INVALID_SPEED;
  return ERROR;
}

STATUS mastSetLoadCntrl(MAST_LOAD *load, int *report) {
  if (load->mass <= 5) return OK;
  *report = S_mast_TOO_HEAVY;
  return ERROR;
}

STATUS mastRaiseCntrl(double *height, int *report) {
  if (*height >= 0 && *height <= MAST_HEIGHT_MAX) return OK;
  *report = S_mast_TOO_HIGH;
  return ERROR;
}
