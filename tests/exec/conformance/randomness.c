// SPDX-License-Identifier: BSD-3-Clause
// System random numbers. They are printed: equal seeds must give equal output.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <stdint.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/times.h>

static void print_bytes(const unsigned char* bytes, size_t size) {
  for (size_t at = 0; at < size; ++at) printf("%02x", bytes[at]);
  printf("\n");
}
static unsigned char buffer[300], zeros[300];

CASE(getrandom_fills_what_it_is_given) {
  EXPECT_IS(getrandom(buffer, 100, 0), 100);
  EXPECT(memcmp(buffer, zeros, 100) != 0);
  EXPECT(memcmp(buffer + 100, zeros, 200) == 0);
  print_bytes(buffer, 100);
}
CASE(getrandom_gives_other_bytes_each_time) {
  EXPECT_IS(getrandom(buffer, 32, GRND_NONBLOCK), 32);
  EXPECT_IS(getrandom(buffer + 100, 32, GRND_RANDOM), 32);
  EXPECT(memcmp(buffer, buffer + 100, 32) != 0);
  EXPECT_IS(getrandom(buffer, 0, 0), 0);
}
CASE(getrandom_refuses_what_is_no_flag) { EXPECT_FAILS(getrandom(buffer, 8, 0x4000), EINVAL); }
CASE(getrandom_refuses_flags_that_exclude_each_other) {
  // In glibc 2.41, getrandom() itself does not look, where the system has it as a function of the process's.
  EXPECT_FAILS(syscall(SYS_getrandom, buffer, 8, GRND_RANDOM | GRND_INSECURE), EINVAL);
}
CASE(getrandom_fills_sizes_that_are_no_multiples) {
  for (size_t size = 1; size < 20; ++size) {
    memset(buffer, 0, sizeof buffer);
    EXPECT_IS(getrandom(buffer, size, 0), (long)size);
    EXPECT_IS(buffer[size], 0);
  }
}
CASE(getrandom_by_syscall_gives_the_same_kind) {
  EXPECT_IS(syscall(SYS_getrandom, buffer, 16, 0), 16);
  EXPECT(memcmp(buffer, zeros, 16) != 0);
  print_bytes(buffer, 16);
}
CASE(getentropy_fills_up_to_256_bytes) {
  EXPECT_IS(getentropy(buffer, 256), 0);
  EXPECT(memcmp(buffer, zeros, 256) != 0);
  print_bytes(buffer, 256);
}
CASE(getentropy_refuses_more) { EXPECT_FAILS(getentropy(buffer, 257), EIO); }
CASE(arc4random_gives_numbers) {
  const uint32_t a = arc4random(), b = arc4random(), c = arc4random();
  EXPECT(a != b || b != c);
  printf("%u %u %u\n", a, b, c);
}
CASE(arc4random_buf_fills_what_it_is_given) {
  arc4random_buf(buffer, 50);
  EXPECT(memcmp(buffer, zeros, 50) != 0);
  EXPECT_IS(buffer[50], 0);
  print_bytes(buffer, 50);
}
CASE(arc4random_uniform_stays_below_its_bound) {
  int seen[6] = {0};
  for (int i = 0; i < 300; ++i) {
    const uint32_t number = arc4random_uniform(6);
    EXPECT(number < 6);
    ++seen[number];
    printf("%u", number);
  }
  printf("\n");
  for (int i = 0; i < 6; ++i) EXPECT(seen[i] > 10);
}
CASE(arc4random_uniform_of_nothing_is_zero) {
  EXPECT_IS(arc4random_uniform(0), 0);
  EXPECT_IS(arc4random_uniform(1), 0);
}

// Not random, but natively different in each run.
CASE(clocks_repeat_with_the_seed) {
  struct timespec time;
  struct tms ticks;
  timespec_get(&time, TIME_UTC);
  printf("%lld %ld %lld %ld %ld\n", now_ns(CLOCK_REALTIME), time.tv_nsec, now_ns(CLOCK_PROCESS_CPUTIME_ID),
         (long)times(&ticks), (long)clock());
  clock_getres(CLOCK_MONOTONIC, &time);
  printf("%ld\n", time.tv_nsec);
}
static void* note_number(void* number) {
  sched_yield();
  note(number);
  return NULL;
}
CASE(the_order_of_threads_repeats_with_the_seed) {
  pthread_t ids[6];
  static const char* const names[] = {"a", "b", "c", "d", "e", "f"};
  for (int i = 0; i < 6; ++i) ids[i] = start(note_number, (void*)names[i]);
  for (int i = 0; i < 6; ++i) join(ids[i]);
  EXPECT_IS(strlen(noted), 6);
  puts(noted);
}
CASE(addresses_repeat_with_the_seed) {
  int local;
  printf("%p %p %p %p\n", (void*)&local, malloc(10), (void*)main, (void*)&printf);
}

CASE(random_files_give_bytes) {
  static const char* const paths[] = {"/dev/urandom", "/dev/random"};
  for (int i = 0; i < 2; ++i) {
    unsigned char bytes[64] = {0}, others[64] = {0};
    const int descriptor = open(paths[i], O_RDONLY);
    EXPECT_IS(read(descriptor, bytes, sizeof bytes), 64);
    EXPECT_IS(read(descriptor, others, sizeof others), 64);
    EXPECT(memcmp(bytes, others, sizeof bytes) != 0);
    for (int k = 0; k < 64; ++k) printf("%02x", bytes[k]);
    close(descriptor);
  }
}

// Libraries draw their seeds when they are loaded.
static unsigned char early[2][16];
__attribute__((constructor)) static void draw_early(void) {
  const int descriptor = open("/dev/urandom", O_RDONLY);
  if (read(descriptor, early[0], sizeof early[0]) != (ssize_t)sizeof early[0]) abort();
  close(descriptor);
  FILE* const stream = fopen("/dev/urandom", "rb");
  if (fread(early[1], sizeof early[1], 1, stream) != 1) abort();
  fclose(stream);
}
CASE(random_files_give_bytes_before_main) {
  EXPECT(memcmp(early[0], early[1], sizeof early[0]) != 0);
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 16; ++k) printf("%02x", early[i][k]);
}

CASE(processor_time_repeats_with_the_seed) {
  struct rusage usage;
  for (int i = 0; i < 1000; ++i) now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(getrusage(RUSAGE_SELF, &usage), 0);
  printf("%ld.%06ld %ld\n", (long)usage.ru_utime.tv_sec, (long)usage.ru_utime.tv_usec, usage.ru_nvcsw);
}
