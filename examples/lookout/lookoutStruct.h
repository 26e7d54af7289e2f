/* SPDX-License-Identifier: BSD-3-Clause */
/* The types of the module `lookout`. */
#ifndef LOOKOUT_STRUCT_H
#define LOOKOUT_STRUCT_H

typedef struct LOOKOUT_VIEW {
  double height;   /* m: of the mast when the view was taken */
  int number;      /* counts the views */
  char with[16];   /* what the mast carries */
} LOOKOUT_VIEW;

#endif
