// SPDX-License-Identifier: BSD-3-Clause
//
// Lines handed from one program to the next, as robots' modules do it: a System V shared memory that holds one, and two
// semaphores, of which one counts free places and the other lines to be read.
#include <stddef.h>

enum { line_size = 80 };

struct lines;

// The memory of this key, made by whoever comes first.
struct lines* lines_open(int key);
// Waits until the line before was taken.
void lines_put(struct lines* lines, const char* line);
// Waits for a line.
void lines_take(struct lines* lines, char line[line_size]);
// The last to use it takes it away.
void lines_remove(struct lines* lines);
