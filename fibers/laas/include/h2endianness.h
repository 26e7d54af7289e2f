/* SPDX-License-Identifier: BSD-3-Clause */
/* The order of the bytes of a number. */
#ifndef WAITPOINT_LAAS_H2ENDIANNESS_H
#define WAITPOINT_LAAS_H2ENDIANNESS_H

typedef enum H2_ENDIANNESS { H2_BIG_ENDIAN, H2_LITTLE_ENDIAN } H2_ENDIANNESS;

#define H2_LOCAL_ENDIANNESS (h2localEndianness())

#ifdef __cplusplus
extern "C" {
#endif

H2_ENDIANNESS h2localEndianness(void);

#ifdef __cplusplus
}
#endif

#endif
