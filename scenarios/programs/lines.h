// SPDX-License-Identifier: BSD-3-Clause
//
// A channel of lines between programs, as in robots' software: System V shared memory for one line, and two semaphores,
// which count free places and unread lines.
#include <stddef.h>

enum { line_size = 80 };

struct lines;

// Opens the channel of this key; the first call creates it.
struct lines* lines_open(int key);
// Writes a line; blocks until the previous one has been taken.
void lines_put(struct lines* lines, const char* line);
// Reads a line; blocks until there is one.
void lines_take(struct lines* lines, char line[line_size]);
// Removes the channel; call from its last user.
void lines_remove(struct lines* lines);
