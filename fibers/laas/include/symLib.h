/* SPDX-License-Identifier: BSD-3-Clause */
/* Symbols: the functions and variables that the program exports (linked with -rdynamic), and those added by symAdd().
 */
#ifndef WAITPOINT_LAAS_SYMLIB_H
#define WAITPOINT_LAAS_SYMLIB_H

#include "fibers/laas/include/portLib.h"

typedef void* SYMTAB_ID;
#define sysSymTbl ((SYMTAB_ID)0)

typedef int SYM_TYPE;
#define SYM_UNDF 0x0
#define SYM_LOCAL 0x0
#define SYM_GLOBAL 0x1
#define SYM_ABS 0x2
#define SYM_TEXT 0x4
#define SYM_DATA 0x6
#define SYM_BSS 0x8

#define M_symLib 28
#define S_symLib_SYMBOL_NOT_FOUND H2_ENCODE_ERR(M_symLib, 1)
#define S_symLib_NOT_IMPLEMENTED H2_ENCODE_ERR(M_symLib, 2)

#ifdef __cplusplus
extern "C" {
#endif

STATUS symLibInit(void);
/* Registers a symbol for the robot, before those of the same name: VxWorks' call, which pocolibs lacks. */
STATUS symAdd(SYMTAB_ID symTblId, char* name, char* value, SYM_TYPE type, unsigned short group);
STATUS symFindByName(SYMTAB_ID symTblId, char* name, char** pValue, SYM_TYPE* pType);
/* S_symLib_NOT_IMPLEMENTED, as in pocolibs. */
STATUS symFindByValue(SYMTAB_ID symTblId, char* value, char* name, int* pValue, SYM_TYPE* pType);

#ifdef __cplusplus
}
#endif

#endif
