// SPDX-License-Identifier: BSD-3-Clause
//
// An allocator that replaces the C library's, without malloc_usable_size(): each block has a guard in front, where the C
// library's function would find a size.
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { guard_bytes = 16, pool_bytes = 1 << 26 };

static _Alignas(4096) char pool[pool_bytes];
static size_t used;

static void* take(size_t alignment, size_t bytes) {
  const size_t room = (bytes + alignment + guard_bytes + 15) / 16 * 16;
  const size_t begin = __atomic_fetch_add(&used, room, __ATOMIC_SEQ_CST);
  if (bytes > pool_bytes || begin > pool_bytes - room) return NULL;
  const uintptr_t block = ((uintptr_t)pool + begin + guard_bytes + alignment - 1) & ~(alignment - 1);
  memset((void*)(block - guard_bytes), 0x7f, guard_bytes);
  return (void*)block;
}

void* malloc(size_t bytes) { return take(16, bytes); }
void* calloc(size_t count, size_t bytes) { return take(16, count * bytes); }
void* memalign(size_t alignment, size_t bytes) { return take(alignment, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) { return take(alignment, bytes); }
int posix_memalign(void** memory, size_t alignment, size_t bytes) {
  *memory = take(alignment, bytes);
  return 0;
}
void* realloc(void* old, size_t bytes) {
  char* const made = take(16, bytes);
  for (size_t i = 0; old != NULL && made != NULL && i < bytes && (char*)old + i < made - guard_bytes; ++i)
    made[i] = ((char*)old)[i];
  return made;
}
void free(void* memory) { (void)memory; }
