/* SPDX-License-Identifier: BSD-3-Clause */
/* Error codes: a library's or module's number, and the error's number in it; and their names. */
#ifndef WAITPOINT_LAAS_H2ERRORLIB_H
#define WAITPOINT_LAAS_H2ERRORLIB_H

#define H2_ENCODE_ERR(M_id, err) ((M_id) << 16 | ((err)&0xffff))
#define H2_SOURCE_ERR(numErr) ((numErr) >> 16)
#define H2_NUMBER_ERR(numErr) ((numErr)&0xffff)
#define H2_DECODE_ERR(numErr) H2_NUMBER_ERR(numErr)

/* A standard error in a module's code: the number of the module that defines it, and its number there, in one byte
 * each. */
#define H2_ENCODE_STD_ERR(M_id, err) ((M_id)&0xff80 || (err)&0xff00 ? 0 : (((M_id)&0x7f) | 0x80) << 8 | ((err)&0xff))
#define H2_TEST_STD_ERR(err) ((err)&0x8000)
#define H2_SOURCE_STD_ERR(numErr) (((numErr)&0x7f00) >> 8)
#define H2_NUMBER_STD_ERR(numErr) ((numErr)&0x00ff)

#include "fibers/laas/include/errnoLib.h"

/* An error's name, without its library's, and its number there. */
typedef struct H2_ERROR {
  const char* name;
  const unsigned short num;
} H2_ERROR;

#ifdef __cplusplus
extern "C" {
#endif

/* Adds the errors of a library or module, which must stay valid. Returns 1; a number that is taken is reported on the
 * standard output, and the first owner keeps it. */
int h2recordErrMsgs(const char* bywho, const char* moduleName, short moduleId, int nbErrors, const H2_ERROR errors[]);
/* Writes the code's name to `string`: S_library_NAME, with numbers in the place of unknown names; the C library's
 * message for its codes; "Unknown error" for 0. Returns `string`. */
char* h2getErrMsg(int fullError, char* string, int maxLength);
/* The same in a text that the next call replaces. */
char* h2getMsgErrno(int fullError);
/* Logs it; h2perror that of the caller's error code, behind `string: `. */
void h2printErrno(int numErr);
void h2perror(const char* string);
/* The code's library; its number there; and of a standard error its module and number, otherwise 0. */
short h2decodeError(int error, short* num, short* srcStd, short* numStd);
/* Print what is recorded, in the order of numbers. */
void h2listModules(void);
void h2listErrors(void);

#ifdef __cplusplus
}
#endif

#endif
