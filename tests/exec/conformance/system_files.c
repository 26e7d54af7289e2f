// SPDX-License-Identifier: BSD-3-Clause
// What the system tells of itself, its processes and its file systems, and names of temporary files. What natively
// differs from run to run is printed: equal seeds must give equal output.
#include "tests/exec/conformance/harness.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/sysinfo.h>
#include <sys/uio.h>
#include <sys/vfs.h>
#include <sys/wait.h>

// The text of a file, by read().
static char text[1 << 16];
static const char* text_of(const char* path) {
  const int file = open(path, O_RDONLY);
  EXPECT(file >= 0);
  ssize_t size = 0, more;
  while ((more = read(file, text + size, sizeof text - 1 - (size_t)size)) > 0) size += more;
  EXPECT_IS(more, 0);
  text[size] = '\0';
  close(file);
  return text;
}
// The same by a FILE*.
static const char* stream_text_of(const char* path) {
  FILE* const file = fopen(path, "r");
  EXPECT(file != NULL);
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  EXPECT_IS(fclose(file), 0);
  return text;
}
static long long number_behind(const char* in, const char* word) {
  const char* const at = strstr(in, word);
  EXPECT(at != NULL);
  return atoll(at + strlen(word));
}

CASE(the_time_since_the_start_is_the_clocks) {
  const double read = atof(text_of("/proc/uptime")), clock = (double)now_ns(CLOCK_BOOTTIME) / 1e9;
  EXPECT(read <= clock);
  EXPECT(read > clock - 5);
  printf("%s", stream_text_of("/proc/uptime"));
}
CASE(the_load_has_five_words) {
  float loads[3];
  int running, all, last;
  EXPECT_IS(
      sscanf(text_of("/proc/loadavg"), "%f %f %f %d/%d %d", &loads[0], &loads[1], &loads[2], &running, &all, &last), 6);
  printf("%s", text);
  double averages[3];
  EXPECT_IS(getloadavg(averages, 3), 3);
  printf("%g\n", averages[0]);
}
CASE(the_processors_times_have_a_line_each) {
  int lines = 0;
  for (const char* at = strstr(text_of("/proc/stat"), "cpu"); at != NULL; at = strstr(at + 1, "\ncpu")) ++lines;
  EXPECT_IS(lines, sysconf(_SC_NPROCESSORS_ONLN) + 1);
  EXPECT(llabs(number_behind(text, "btime ") - (now_ns(CLOCK_REALTIME) - now_ns(CLOCK_BOOTTIME)) / 1000000000) < 10);
  printf("%s", text);
}
CASE(the_memory_is_that_of_sysinfo) {
  struct sysinfo state;
  EXPECT_IS(sysinfo(&state), 0);
  const long long total = (long long)state.totalram * state.mem_unit, free = (long long)state.freeram * state.mem_unit;
  EXPECT_IS(number_behind(text_of("/proc/meminfo"), "MemTotal:"), total / 1024);
  EXPECT(number_behind(text, "MemFree:") <= total / 1024);
  EXPECT(free <= total);
  EXPECT(state.uptime <= now_ns(CLOCK_BOOTTIME) / 1000000000 + 1);
  printf("%s%ld %lu %u %lld %ld\n", text, state.uptime, state.loads[0], state.procs, free, sysconf(_SC_AVPHYS_PAGES));
}
CASE(ids_of_the_process_are_those_of_the_functions) {
  char state;
  int id, parent, group, session;
  EXPECT_IS(sscanf(text_of("/proc/self/stat"), "%d (system_files) %c %d %d %d", &id, &state, &parent, &group, &session),
            5);
  EXPECT_IS(id, getpid());
  EXPECT_IS(state, 'R');
  EXPECT_IS(parent, getppid());
  EXPECT_IS(group, getpgrp());
  EXPECT_IS(session, getsid(0));
  int words = 0;
  for (const char* at = text; (at = strchr(at, ' ')) != NULL; ++at) ++words;
  EXPECT_IS(words, 51);
  EXPECT_IS(number_behind(text_of("/proc/self/status"), "\nPid:"), getpid());
  EXPECT_IS(number_behind(text, "\nPPid:"), getppid());
  EXPECT_IS(number_behind(text, "\nThreads:"), 1);
  EXPECT(number_behind(text, "\nVmRSS:") > 0);
  printf("%s", stream_text_of("/proc/self/status"));
}
CASE(its_folder_has_its_number_as_name) {
  char path[64];
  snprintf(path, sizeof path, "/proc/%d/stat", getpid());
  EXPECT_IS(atoi(text_of(path)), getpid());
  snprintf(path, sizeof path, "/proc/%d/comm", getpid());
  EXPECT_IS(strcmp(stream_text_of(path), "system_files\n"), 0);
  EXPECT_IS(strcmp(text_of(path), "system_files\n"), 0);
}
CASE(a_child_has_a_folder_too) {
  char path[64];
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(50);
    _exit(0);
  }
  snprintf(path, sizeof path, "/proc/%d/stat", child);
  const char* const behind = strrchr(text_of(path), ')');
  EXPECT(behind != NULL);
  EXPECT_IS(atoi(text), child);
  EXPECT_IS(atoi(behind + 3), getpid());
  EXPECT_IS(waitpid(child, NULL, 0), child);
}
CASE(signals_of_the_process_are_told) {
  signal(SIGUSR1, SIG_IGN);
  text_of("/proc/self/status");
  EXPECT((strtoull(strstr(text, "SigIgn:") + 7, NULL, 16) & (1ULL << (SIGUSR1 - 1))) != 0);
}
CASE(the_memory_of_the_process_repeats) {
  struct rusage usage;
  EXPECT_IS(getrusage(RUSAGE_SELF, &usage), 0);
  EXPECT(usage.ru_maxrss > 0);
  int words[7];
  EXPECT_IS(sscanf(text_of("/proc/self/statm"), "%d %d %d %d %d %d %d", &words[0], &words[1], &words[2], &words[3],
                   &words[4], &words[5], &words[6]),
            7);
  printf("%ld %ld %s", usage.ru_maxrss, usage.ru_minflt, text);
  EXPECT_IS(getrusage(RUSAGE_CHILDREN, &usage), 0);
  printf("%ld\n", (long)usage.ru_utime.tv_usec);
  EXPECT_FAILS(getrusage((__rusage_who_t)77, &usage), EINVAL);
}
CASE(the_map_of_memory_has_the_program) {
  EXPECT(strstr(text_of("/proc/self/maps"), "system_files") != NULL);
  EXPECT(strstr(text, "[stack]") != NULL);
}
CASE(file_systems_have_room) {
  struct statvfs first, second;
  struct statfs third, fourth;
  EXPECT_IS(statvfs(".", &first), 0);
  const int folder = open(".", O_RDONLY | O_DIRECTORY);
  EXPECT_IS(fstatvfs(folder, &second), 0);
  EXPECT_IS(statfs(".", &third), 0);
  EXPECT_IS(fstatfs(folder, &fourth), 0);
  EXPECT_IS(first.f_blocks, second.f_blocks);
  EXPECT_IS(third.f_blocks, fourth.f_blocks);
  EXPECT(first.f_bfree <= first.f_blocks);
  EXPECT(first.f_bavail <= first.f_blocks);
  printf("%lu %lu %lu %lu\n", (unsigned long)first.f_bfree, (unsigned long)second.f_ffree,
         (unsigned long)third.f_bavail, (unsigned long)fourth.f_ffree);
}
CASE(functions_for_files_of_any_size_have_two_names) {
  struct statvfs first, second;
  struct statfs third, fourth;
  int (*const by_name)(const char*, struct statvfs*) =
      (int (*)(const char*, struct statvfs*))dlsym(RTLD_DEFAULT, "statvfs");
  int (*const old)(const char*, struct statfs*) = (int (*)(const char*, struct statfs*))dlsym(RTLD_DEFAULT, "statfs");
  EXPECT_IS(by_name("/", &first), 0);
  EXPECT_IS(statvfs("/", &second), 0);
  EXPECT_IS(old("/", &third), 0);
  EXPECT_IS(statfs("/", &fourth), 0);
  EXPECT_IS(first.f_blocks, second.f_blocks);
  EXPECT_IS(third.f_blocks, fourth.f_blocks);
  EXPECT_IS(first.f_blocks * first.f_frsize, (unsigned long)third.f_blocks * (unsigned long)third.f_frsize);
  printf("%lu %lu\n", (unsigned long)first.f_bfree, (unsigned long)third.f_bfree);
}
CASE(free_pages_are_pages_of_the_machine) {
  EXPECT(get_avphys_pages() > 0);
  EXPECT(get_avphys_pages() <= get_phys_pages());
  printf("%ld\n", get_avphys_pages());
}
CASE(random_numbers_of_the_system_are_uuids) {
  EXPECT_IS(strlen(text_of("/proc/sys/kernel/random/uuid")), 37);
  EXPECT_IS(text[14], '4');
  char first[40];
  strcpy(first, text);
  EXPECT(strcmp(first, text_of("/proc/sys/kernel/random/uuid")) != 0);
  printf("%s%s", first, text);
  strcpy(first, text_of("/proc/sys/kernel/random/boot_id"));
  EXPECT_IS(strcmp(first, text_of("/proc/sys/kernel/random/boot_id")), 0);
  EXPECT(atoi(text_of("/proc/sys/kernel/random/entropy_avail")) > 0);
  printf("%s%s", first, text);
}

static const unsigned char zeros[64];
static void print_bytes(const unsigned char* bytes) {
  for (int i = 0; i < 16; ++i) printf("%02x", bytes[i]);
  printf("\n");
}
CASE(streams_of_the_random_device_repeat_with_the_seed) {
  unsigned char bytes[64] = {0}, others[64] = {0};
  FILE* const file = fopen("/dev/urandom", "rb");
  EXPECT(file != NULL);
  EXPECT_IS(fread(bytes, 1, sizeof bytes, file), 64);
  EXPECT(fileno(file) >= 0);
  EXPECT_IS(read(fileno(file), others, sizeof others), 64);
  EXPECT(memcmp(bytes, others, sizeof bytes) != 0);
  EXPECT(memcmp(bytes, zeros, sizeof bytes) != 0);
  print_bytes(bytes);
  const int descriptor = fileno(file);
  EXPECT_IS(fclose(file), 0);
  EXPECT_FAILS(fcntl(descriptor, F_GETFD), EBADF);
}
CASE(a_stream_of_its_descriptor_does_too) {
  unsigned char bytes[64] = {0};
  const int descriptor = open("/dev/urandom", O_RDONLY | O_CLOEXEC);
  FILE* const file = fdopen(descriptor, "r");
  EXPECT_IS(fileno(file), descriptor);
  EXPECT_IS(fcntl(descriptor, F_GETFD), FD_CLOEXEC);
  EXPECT_IS(fread(bytes, 1, sizeof bytes, file), 64);
  print_bytes(bytes);
  fclose(file);
}
CASE(pieces_are_filled_with_random_bytes) {
  unsigned char bytes[64] = {0};
  const struct iovec pieces[2] = {{bytes, 20}, {bytes + 20, 44}};
  const int descriptor = open("/dev/urandom", O_RDONLY);
  EXPECT_IS(readv(descriptor, pieces, 2), 64);
  EXPECT(memcmp(bytes + 20, zeros, 44) != 0);
  print_bytes(bytes);
  close(descriptor);
}

// Names in a folder of the case's own.
static char folder[] = "/tmp/system_files.XXXXXX";
static void enter_folder(void) {
  EXPECT(mkdtemp(folder) == folder);
  EXPECT(strcmp(folder + strlen(folder) - 6, "XXXXXX") != 0);
  EXPECT_IS(chdir(folder), 0);
}
static void leave_folder(void) {
  EXPECT_IS(chdir("/"), 0);
  EXPECT_IS(rmdir(folder), 0);
}
static void expect_private_file(int descriptor, const char* name) {
  struct stat by_descriptor, by_name;
  EXPECT(descriptor >= 0);
  EXPECT_IS(fstat(descriptor, &by_descriptor), 0);
  EXPECT_IS(stat(name, &by_name), 0);
  EXPECT_IS(by_descriptor.st_ino, by_name.st_ino);
  EXPECT_IS(by_name.st_mode & 07777, 0600);
  EXPECT_IS(fcntl(descriptor, F_GETFL) & O_ACCMODE, O_RDWR);
  EXPECT_IS(close(descriptor), 0);
  EXPECT_IS(unlink(name), 0);
  puts(name);
}
CASE(temporary_files_have_names_of_the_form_given) {
  enter_folder();
  char names[4][32] = {"first.XXXXXX", "second.XXXXXX", "third.XXXXXX.txt", "fourth.XXXXXX.c"};
  expect_private_file(mkstemp(names[0]), names[0]);
  const int closing = mkostemp(names[1], O_CLOEXEC);
  EXPECT_IS(fcntl(closing, F_GETFD), FD_CLOEXEC);
  expect_private_file(closing, names[1]);
  expect_private_file(mkstemps(names[2], 4), names[2]);
  expect_private_file(mkostemps(names[3], 2, O_APPEND), names[3]);
  EXPECT_IS(strncmp(names[0], "first.", 6), 0);
  EXPECT_IS(strcmp(names[2] + 12, ".txt"), 0);
  leave_folder();
}
CASE(temporary_files_differ_from_each_other) {
  enter_folder();
  char first[] = "XXXXXX", second[] = "XXXXXX";
  const int one = mkstemp(first), other = mkstemp(second);
  EXPECT(strcmp(first, second) != 0);
  expect_private_file(one, first);
  expect_private_file(other, second);
  leave_folder();
}
CASE(forms_without_marks_are_refused) {
  char wrong[] = "name.XXXXX", right[] = "name.XXXXXX";
  EXPECT_FAILS(mkstemp(wrong), EINVAL);
  EXPECT_FAILS(mkstemps(right, 1), EINVAL);
  EXPECT_FAILS(mkstemps(right, 20), EINVAL);
  EXPECT(mkdtemp(wrong) == NULL);
  char nowhere[] = "/no/folder/XXXXXX";
  EXPECT_FAILS(mkstemp(nowhere), ENOENT);
}
CASE(names_of_temporary_files_are_free) {
  char name[L_tmpnam], form[] = "/tmp/XXXXXX";
  struct stat state;
  EXPECT(tmpnam_r(name) == name);
  EXPECT_FAILS(stat(name, &state), ENOENT);
  puts(name);
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  puts(mktemp(form));
  puts(tmpnam(NULL));
  unsetenv("TMPDIR");
  char* const allocated = tempnam("/tmp", "abc");
  EXPECT_IS(strncmp(allocated, "/tmp/abc", 8), 0);
  puts(allocated);
  free(allocated);
}
