/* SPDX-License-Identifier: BSD-3-Clause */
/* The types of the module `mast`. */
#ifndef MAST_STRUCT_H
#define MAST_STRUCT_H

#define MAST_HEIGHT_MAX 2.0 /* m */
#define MAST_NAME_SIZE 16

typedef enum MAST_SPEED { MAST_SLOW, MAST_FAST } MAST_SPEED;

typedef struct MAST_STATE {
  double height; /* m */
  double speed;  /* m/s, upwards */
} MAST_STATE;

typedef struct MAST_LOAD {
  char name[MAST_NAME_SIZE];
  double mass; /* kg */
} MAST_LOAD;

#endif
