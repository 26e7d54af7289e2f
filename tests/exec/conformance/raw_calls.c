// SPDX-License-Identifier: BSD-3-Clause
// System calls by instructions of the program's own, and functions that it looks up in the C library.
#include "tests/exec/conformance/harness.h"

#include <cpuid.h>
#include <dirent.h>
#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <setjmp.h>
#include <signal.h>
#include <sys/auxv.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>

static long raw(long number, long first, long second, long third, long fourth) {
  long result = number;
  register long in_r10 __asm__("r10") = fourth;
  register long in_r8 __asm__("r8") = 0;
  register long in_r9 __asm__("r9") = 0;
  __asm__ volatile("syscall"
                   : "+a"(result)
                   : "D"(first), "S"(second), "d"(third), "r"(in_r10), "r"(in_r8), "r"(in_r9)
                   : "rcx", "r11", "memory");
  return result;
}

CASE(the_clock_is_the_one_of_the_functions) {
  struct timespec time;
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(raw(SYS_clock_gettime, CLOCK_REALTIME, (long)&time, 0, 0), 0);
  const long long read = time.tv_sec * 1000000000LL + time.tv_nsec;
  EXPECT(read >= before);
  EXPECT(read <= now_ns(CLOCK_REALTIME));
  printf("%lld\n", read);
}
CASE(ids_are_those_of_the_functions) {
  EXPECT_IS(raw(SYS_getpid, 0, 0, 0, 0), getpid());
  EXPECT_IS(raw(SYS_getppid, 0, 0, 0, 0), getppid());
  EXPECT_IS(raw(SYS_gettid, 0, 0, 0, 0), gettid());
  printf("%ld\n", raw(SYS_getpid, 0, 0, 0, 0));
}
CASE(random_numbers_repeat_with_the_seed) {
  unsigned long number = 0;
  EXPECT_IS(raw(SYS_getrandom, (long)&number, sizeof number, 0, 0), 8);
  printf("%lx\n", number);
}
CASE(errors_are_negative_and_errno_stays) {
  errno = 7;
  EXPECT_IS(raw(SYS_close, -1, 0, 0, 0), -EBADF);
  EXPECT_IS(raw(SYS_getrandom, 0, 0, 0x4000, 0), -EINVAL);
  EXPECT_IS(raw(100000, 0, 0, 0, 0), -ENOSYS);
  EXPECT_IS(errno, 7);
}
CASE(other_calls_are_the_systems) {
  const int descriptor = (int)raw(SYS_memfd_create, (long)"raw", 0, 0, 0);
  EXPECT(descriptor >= 0);
  EXPECT_IS(raw(SYS_write, descriptor, (long)"four", 4, 0), 4);
  EXPECT_IS(raw(SYS_lseek, descriptor, 0, SEEK_END, 0), 4);
  EXPECT_IS(raw(SYS_close, descriptor, 0, 0, 0), 0);
}

static int word;
static void* wait_for_word(void* unused) {
  note("waits ");
  while (__atomic_load_n(&word, __ATOMIC_SEQ_CST) == 0) raw(SYS_futex, (long)&word, FUTEX_WAIT_PRIVATE, 0, 0);
  note("continues");
  return unused;
}
CASE(a_wait_on_a_futex_lets_other_threads_run) {
  const pthread_t waiter = start(wait_for_word, NULL);
  let_others_wait();
  EXPECT_NOTED("waits ");
  __atomic_store_n(&word, 1, __ATOMIC_SEQ_CST);
  EXPECT_IS(raw(SYS_futex, (long)&word, FUTEX_WAKE_PRIVATE, 1, 0), 1);
  join(waiter);
  EXPECT_NOTED("waits continues");
}
CASE(a_sleep_takes_its_time) {
  const struct timespec span = {0, 20000000};
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(raw(SYS_nanosleep, (long)&span, 0, 0, 0), 0);
  EXPECT(now_ns(CLOCK_MONOTONIC) - before >= 20000000);
}
static int ends[2];
static void* write_late(void* unused) {
  sleep_ms(5);
  EXPECT_IS(raw(SYS_write, ends[1], (long)"x", 1, 0), 1);
  return unused;
}
CASE(a_read_of_a_pipe_waits_for_another_threads_write) {
  char byte = 0;
  EXPECT_IS(pipe(ends), 0);
  const pthread_t writer = start(write_late, NULL);
  EXPECT_IS(raw(SYS_read, ends[0], (long)&byte, 1, 0), 1);
  EXPECT_IS(byte, 'x');
  join(writer);
}
CASE(they_are_answered_in_a_forked_child_too) {
  const pid_t child = fork();
  if (child == 0) _exit(raw(SYS_getpid, 0, 0, 0, 0) == getpid() && raw(SYS_getppid, 0, 0, 0, 0) == getppid() ? 3 : 4);
  int status = 0;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(WEXITSTATUS(status), 3);
}
static volatile sig_atomic_t handled;
static void count(int signal) {
  (void)signal;
  handled += raw(SYS_getpid, 0, 0, 0, 0) == getpid();
}
CASE(they_are_answered_in_a_signal_handler) {
  signal(SIGUSR1, count);
  EXPECT_IS(raw(SYS_tgkill, getpid(), gettid(), SIGUSR1, 0), 0);
  EXPECT_IS(handled, 1);
}
CASE(a_handler_of_the_signal_by_which_they_are_trapped_sees_none_of_them) {
  signal(SIGSYS, count);
  EXPECT_IS(raw(SYS_getpid, 0, 0, 0, 0), getpid());
  EXPECT_IS(handled, 0);
  raise(SIGSYS);
  EXPECT_IS(handled, 1);
}

CASE(functions_found_in_the_c_library_are_simulated) {
  void* const library = dlopen("libc.so.6", RTLD_LAZY);
  EXPECT(library != NULL);
  pid_t (*const own_id)(void) = (pid_t(*)(void))dlsym(library, "getpid");
  int (*const clock)(clockid_t, struct timespec*) =
      (int (*)(clockid_t, struct timespec*))dlsym(library, "clock_gettime");
  EXPECT(own_id != NULL && clock != NULL);
  struct timespec time;
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(clock(CLOCK_REALTIME, &time), 0);
  const long long read = time.tv_sec * 1000000000LL + time.tv_nsec;
  EXPECT(read >= before);
  EXPECT(read <= now_ns(CLOCK_REALTIME));
  EXPECT_IS(own_id(), getpid());
  printf("%d %lld\n", own_id(), read);
}
CASE(other_functions_of_the_c_library_are_found_there) {
  void* const library = dlopen("libc.so.6", RTLD_LAZY);
  EXPECT(dlsym(library, "strtol") != NULL);
  EXPECT_IS(((long (*)(const char*, char**, int))dlsym(library, "strtol"))("17", NULL, 10), 17);
  EXPECT(dlsym(library, "no_function_of_this_name") == NULL);
  EXPECT(dlerror() != NULL);
}

CASE(files_are_those_of_the_functions) {
  struct stat by_function, raw_state;
  char bytes[4096], link[20] = {0};
  EXPECT_IS(stat("/", &by_function), 0);
  EXPECT_IS(raw(SYS_stat, (long)"/", (long)&raw_state, 0, 0), 0);
  EXPECT_IS(raw_state.st_ino, by_function.st_ino);
  EXPECT_IS(raw(SYS_newfstatat, AT_FDCWD, (long)"/", (long)&raw_state, 0), 0);
  EXPECT_IS(raw_state.st_ino, by_function.st_ino);
  EXPECT_IS(raw(SYS_readlink, (long)"/proc/self", (long)link, sizeof link, 0),
            snprintf(bytes, sizeof bytes, "%d", getpid()));
  EXPECT_IS(atoi(link), getpid());
  EXPECT_IS(raw(SYS_stat, 8, (long)&raw_state, 0, 0), -EFAULT);
  EXPECT_IS(raw(SYS_stat, (long)"/", 8, 0, 0), -EFAULT);
  const int folder = (int)raw(SYS_openat, AT_FDCWD, (long)"/", O_RDONLY | O_DIRECTORY, 0);
  const long size = raw(SYS_getdents64, folder, (long)bytes, sizeof bytes, 0);
  EXPECT(size > 0);
  for (long at = 0; at < size; at += ((struct dirent*)(bytes + at))->d_reclen) {
    const struct dirent* const entry = (struct dirent*)(bytes + at);
    if (strcmp(entry->d_name, ".") == 0) EXPECT_IS(entry->d_ino, by_function.st_ino);
  }
}

// A function of the image that the system maps into each process; null without it.
static void* mapped_function(const char* name) {
  char* const image = (char*)getauxval(AT_SYSINFO_EHDR);
  if (image == NULL) return NULL;
  const Elf64_Ehdr* const header = (const Elf64_Ehdr*)image;
  const Elf64_Shdr* const sections = (const Elf64_Shdr*)(image + header->e_shoff);
  for (int i = 0; i < header->e_shnum; ++i) {
    if (sections[i].sh_type != SHT_DYNSYM) continue;
    const Elf64_Sym* const symbols = (const Elf64_Sym*)(image + sections[i].sh_offset);
    const char* const names = image + sections[sections[i].sh_link].sh_offset;
    for (size_t k = 0; k < sections[i].sh_size / sizeof *symbols; ++k)
      if (strcmp(names + symbols[k].st_name, name) == 0) return image + symbols[k].st_value;
  }
  return NULL;
}
CASE(functions_mapped_by_the_system_show_the_same_clocks) {
  int (*const clock)(clockid_t, struct timespec*) =
      (int (*)(clockid_t, struct timespec*))mapped_function("__vdso_clock_gettime");
  time_t (*const seconds)(time_t*) = (time_t(*)(time_t*))mapped_function("__vdso_time");
  if (clock == NULL || seconds == NULL) return;
  struct timespec time;
  const long long before = now_ns(CLOCK_MONOTONIC);
  EXPECT_IS(clock(CLOCK_MONOTONIC, &time), 0);
  const long long read = time.tv_sec * 1000000000LL + time.tv_nsec;
  EXPECT(read >= before);
  EXPECT(read <= now_ns(CLOCK_MONOTONIC));
  EXPECT(llabs(seconds(NULL) - now_ns(CLOCK_REALTIME) / 1000000000) <= 1);
  printf("%lld %ld\n", read, (long)seconds(NULL));
}
static void* set_word_late(void* unused) {
  sleep_ms(5);
  __atomic_store_n(&word, 1, __ATOMIC_SEQ_CST);
  return unused;
}
CASE(a_loop_that_reads_such_a_clock_ends) {
  int (*const clock)(clockid_t, struct timespec*) =
      (int (*)(clockid_t, struct timespec*))mapped_function("__vdso_clock_gettime");
  struct timespec time;
  const pthread_t other = start(set_word_late, NULL);
  while (clock != NULL && __atomic_load_n(&word, __ATOMIC_SEQ_CST) == 0) EXPECT_IS(clock(CLOCK_MONOTONIC, &time), 0);
  join(other);
}

// What differs between processors of one machine, or in each run, is printed; natively it is not compared.
// Where cpuid cannot be trapped, the number of the core is the system's.
static int cpuid_can_be_trapped(void) {
  char line[8192];
  int found = 0;
  FILE* const file = fopen("/proc/cpuinfo", "r");
  while (file != NULL && !found && fgets(line, sizeof line, file) != NULL) found = strstr(line, " cpuid_fault") != NULL;
  if (file != NULL) fclose(file);
  return found;
}
CASE(the_processor_says_the_same_of_itself_in_each_run) {
  const int trapped = cpuid_can_be_trapped();
  unsigned a = 0, b = 0, c = 0, d = 0;
  EXPECT_IS(__get_cpuid(1, &a, &b, &c, &d), 1);
  printf("%x %x %x %x\n", a, trapped ? b : b & 0xFFFFFF, c, d);
  EXPECT((d & bit_SSE2) != 0);
  if (trapped && __get_cpuid_count(0xB, 0, &a, &b, &c, &d) != 0) printf("%x\n", d);
}
static jmp_buf behind;
static volatile int* volatile nowhere = (volatile int*)8;
static void leave(int signal) {
  (void)signal;
  longjmp(behind, 1);
}
CASE(an_access_to_no_memory_is_a_fault_still) {
  struct sigaction action = {.sa_handler = leave, .sa_flags = SA_NODEFER};
  EXPECT_IS(sigaction(SIGSEGV, &action, NULL), 0);
  if (setjmp(behind) == 0) {
    *nowhere = 1;
    EXPECT(0);
  }
  if (setjmp(behind) == 0) {
    ((void (*)(void))nowhere)();
    EXPECT(0);
  }
}
