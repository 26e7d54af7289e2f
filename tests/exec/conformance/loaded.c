// SPDX-License-Identifier: BSD-3-Clause
// Loaded while threads run: it has variables of each thread.
static __thread int counter = 40;
static __thread char zeros[10000];

int* address_of_counter(void);
int next_count(void);
char* address_of_zeros(void);

int* address_of_counter(void) { return &counter; }
int next_count(void) { return ++counter; }
char* address_of_zeros(void) { return zeros; }
