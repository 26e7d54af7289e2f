// SPDX-License-Identifier: BSD-3-Clause
// gcomLib's letters: a head and data in one block, as they are sent.
#include <cstddef>
#include <cstring>

#include "fibers/laas/pocolibs/letters.hpp"
#include "fibers/laas/pocolibs/memory.hpp"
#include "fibers/laas/portLib.hpp"

using waitpoint::laas::fail;
using waitpoint::laas::is_letter;
using waitpoint::laas::Memory;

namespace {

constexpr int flag_of_letters = 0x12348765;

char* data_of(LETTER_ID letter) { return reinterpret_cast<char*>(letter->pHdr + 1); }
int room_of(LETTER_ID letter) { return letter->size - static_cast<int>(sizeof(LETTER_HDR)); }

}  // namespace

bool waitpoint::laas::is_letter(LETTER_ID letter) {
  if (Memory::here().owns(letter) && letter->flagInit == flag_of_letters) return true;
  fail(S_gcomLib_NOT_A_LETTER);
  return false;
}

STATUS gcomLetterAlloc(int sizeLetter, LETTER_ID* pLetterId) {
  const std::size_t size = sizeof(LETTER_HDR) + static_cast<std::size_t>(MAX(sizeLetter, 0));
  auto* const letter = static_cast<LETTER_ID>(Memory::here().allocate(sizeof(LETTER)));
  letter->pHdr = static_cast<LETTER_HDR_ID>(Memory::here().allocate(size));
  letter->size = static_cast<int>(size);
  letter->flagInit = flag_of_letters;
  *pLetterId = letter;
  return OK;
}

STATUS gcomLetterDiscard(LETTER_ID letterId) {
  if (!is_letter(letterId)) return ERROR;
  Memory::here().release(letterId->pHdr);
  Memory::here().release(letterId);
  return OK;
}

STATUS gcomLetterWrite(LETTER_ID letterId, int dataType, char* pData, int dataSize, GCOM_CODINGFUNC codingFunc) {
  if (!is_letter(letterId)) return ERROR;
  letterId->pHdr->dataType = dataType;
  if (codingFunc != nullptr) {
    letterId->pHdr->dataSize = codingFunc(pData, dataSize, data_of(letterId), room_of(letterId));
    return letterId->pHdr->dataSize == ERROR ? ERROR : OK;
  }
  if (dataSize < 0 || dataSize > room_of(letterId)) return fail(S_gcomLib_SMALL_LETTER);
  letterId->pHdr->dataSize = dataSize;
  if (dataSize > 0) std::memcpy(data_of(letterId), pData, static_cast<std::size_t>(dataSize));
  return OK;
}

int gcomLetterRead(LETTER_ID letterId, char* pData, int maxDataSize, GCOM_CODINGFUNC decodingFunc) {
  if (!is_letter(letterId)) return ERROR;
  const int size = letterId->pHdr->dataSize;
  if (decodingFunc != nullptr) return decodingFunc(data_of(letterId), size, pData, maxDataSize);
  if (maxDataSize < size) return fail(S_gcomLib_SMALL_DATA_STR);
  if (size > 0) std::memcpy(pData, data_of(letterId), static_cast<std::size_t>(size));
  return size;
}

int gcomLetterType(LETTER_ID letterId) { return is_letter(letterId) ? letterId->pHdr->dataType : ERROR; }

int gcomLetterList(LETTER_ID*, int) { return 0; }
