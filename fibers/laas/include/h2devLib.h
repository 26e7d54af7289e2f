/* SPDX-License-Identifier: BSD-3-Clause */
/* h2 devices: the names of a robot's mailboxes, posters and tasks. They exist from its start, as after `h2 init`. */
#ifndef WAITPOINT_LAAS_H2DEVLIB_H
#define WAITPOINT_LAAS_H2DEVLIB_H

#include <sys/types.h>

#include "fibers/laas/include/h2endianness.h"
#include "fibers/laas/include/h2semLib.h"
#include "fibers/laas/include/h2timeLib.h"

typedef enum {
  H2_DEV_TYPE_NONE,
  H2_DEV_TYPE_H2DEV,
  H2_DEV_TYPE_SEM,
  H2_DEV_TYPE_MBOX,
  H2_DEV_TYPE_POSTER,
  H2_DEV_TYPE_TASK,
  H2_DEV_TYPE_MEM
} H2_DEV_TYPE;

/* A name's greatest length, with its end; the number of devices without h2devInit(). */
#define H2_DEV_MAX_NAME 32
#define H2_DEV_MAX_DEFAULT 120

/* A device's id: its index in the table, and in the highest bits how often the place was used before. */
#define H2_DEV_GEN_BITS 12
#define H2DEV_INDEX(dev) ((unsigned int)(dev) & (-1U >> H2_DEV_GEN_BITS))
#define H2DEV_GEN(dev) ((unsigned int)(dev) >> (8 * sizeof(int) - H2_DEV_GEN_BITS))

typedef struct H2_DEV_STR {
  H2_DEV_TYPE type;
  unsigned int devgen; /* the id */
  char name[H2_DEV_MAX_NAME];
  long uid;
} H2_DEV_STR;

#define H2DEV_BY_INDEX(idx) (h2devByIndex(idx)->devgen)
#define H2DEV_DEV(dev) (h2devById(dev))
#define H2DEV_NAME(dev) (H2DEV_DEV(dev)->name)
#define H2DEV_TYPE(dev) (H2DEV_DEV(dev)->type)
#define H2DEV_UID(dev) (H2DEV_DEV(dev)->uid)

/* A poster's accesses. */
typedef struct H2_POSTER_STAT_STR {
  unsigned int read_ops;
  unsigned int write_ops;
  unsigned int read_bytes;
  unsigned int write_bytes;
} H2_POSTER_STAT_STR;

#define M_h2devLib 505
#define S_h2devLib_BAD_DEVICE_TYPE H2_ENCODE_ERR(M_h2devLib, 0)
#define S_h2devLib_DUPLICATE_DEVICE_NAME H2_ENCODE_ERR(M_h2devLib, 1)
#define S_h2devLib_TOO_MANY_DEVICES H2_ENCODE_ERR(M_h2devLib, 2)
#define S_h2devLib_FIND_DEVICE_TIMEOUT H2_ENCODE_ERR(M_h2devLib, 3)
#define S_h2devLib_NOT_OWNER H2_ENCODE_ERR(M_h2devLib, 4)
#define S_h2devLib_NOT_INITIALIZED H2_ENCODE_ERR(M_h2devLib, 5)
#define S_h2devLib_BAD_HOME_DIR H2_ENCODE_ERR(M_h2devLib, 6)
#define S_h2devLib_FULL H2_ENCODE_ERR(M_h2devLib, 7)
#define S_h2devLib_BAD_PARAMETERS H2_ENCODE_ERR(M_h2devLib, 8)
#define S_h2devLib_NOT_FOUND H2_ENCODE_ERR(M_h2devLib, 9)

#ifdef __cplusplus
extern "C" {
#endif

/* Sets the sizes of shared memory and table; EEXIST if it was called before. There is no poster server to start. */
STATUS h2devInit(int smMemSize, int h2devMax, int posterServFlag);
/* The number of places in the table; S_h2devLib_NOT_INITIALIZED after h2devEnd(). */
STATUS h2devAttach(int* h2devMax);
int h2devSize(void);
/* Deletes all devices. */
STATUS h2devEnd(void);
/* A device's id, at the least free place; a name is unique among those of its type. */
int h2devAlloc(const char* name, H2_DEV_TYPE type);
int h2devFind(const char* name, H2_DEV_TYPE type);
STATUS h2devFree(int dev);
/* Deletes the devices whose names match the pattern of a shell; ERROR if there are none. */
STATUS h2devClean(const char* name);
/* Prints the table. */
STATUS h2devShow(void);
/* The device at a place, or with an id: of type H2_DEV_TYPE_NONE if there is none. */
const H2_DEV_STR* h2devByIndex(unsigned int index);
const H2_DEV_STR* h2devById(int dev);

#ifdef __cplusplus
}
#endif

#endif
