// SPDX-License-Identifier: BSD-3-Clause
// Inode numbers and times of files, and the order of directories. What natively differs from run to run is printed:
// equal seeds must give equal output.
#include "tests/exec/conformance/harness.h"

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <utime.h>

static char folder[] = "/tmp/file_states.XXXXXX";
static void enter_folder(void) {
  EXPECT(mkdtemp(folder) == folder);
  EXPECT_IS(chdir(folder), 0);
}
static void leave_folder(void) {
  EXPECT_IS(chdir("/"), 0);
  EXPECT_IS(rmdir(folder), 0);
}
static void make(const char* name, const char* contents) {
  const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  EXPECT(file >= 0);
  EXPECT_IS(write(file, contents, strlen(contents)), (long)strlen(contents));
  EXPECT_IS(close(file), 0);
}
static struct stat state_of(const char* name) {
  struct stat state;
  EXPECT_IS(stat(name, &state), 0);
  return state;
}
static long long ns_of(struct timespec date) { return date.tv_sec * 1000000000LL + date.tv_nsec; }
// The system's dates of files are those of its last tick.
static long long tick_ns = 10000000;

CASE(inodes_tell_files_apart) {
  enter_folder();
  make("one", "");
  make("other", "");
  EXPECT_IS(link("one", "again"), 0);
  EXPECT(state_of("one").st_ino != state_of("other").st_ino);
  EXPECT_IS(state_of("one").st_ino, state_of("again").st_ino);
  EXPECT_IS(state_of("one").st_nlink, 2);
  printf("%lu %lu\n", (unsigned long)state_of("one").st_ino, (unsigned long)state_of("other").st_ino);
  EXPECT_IS(rename("other", "renamed"), 0);
  const ino_t before = state_of("renamed").st_ino;
  EXPECT_IS(rename("renamed", "other"), 0);
  EXPECT_IS(state_of("other").st_ino, before);
  unlink("one"), unlink("other"), unlink("again");
  leave_folder();
}
CASE(each_call_tells_the_same_inode) {
  struct stat by_name, by_descriptor, in_folder, of_link;
  struct statx extended;
  enter_folder();
  make("file", "text");
  const int descriptor = open("file", O_RDONLY);
  EXPECT_IS(stat("file", &by_name), 0);
  EXPECT_IS(lstat("file", &of_link), 0);
  EXPECT_IS(fstat(descriptor, &by_descriptor), 0);
  EXPECT_IS(fstatat(AT_FDCWD, "file", &in_folder, 0), 0);
  EXPECT_IS(statx(AT_FDCWD, "file", 0, STATX_INO, &extended), 0);
  EXPECT_IS(by_name.st_ino, by_descriptor.st_ino);
  EXPECT_IS(by_name.st_ino, of_link.st_ino);
  EXPECT_IS(by_name.st_ino, in_folder.st_ino);
  EXPECT_IS(by_name.st_ino, (ino_t)extended.stx_ino);
  EXPECT_IS(by_name.st_size, 4);
  EXPECT_IS(by_name.st_dev, by_descriptor.st_dev);
  EXPECT_IS(by_name.st_mode, S_IFREG | 0644);
  EXPECT_IS(by_name.st_uid, geteuid());
  printf("%lu\n", (unsigned long)by_name.st_ino);
  close(descriptor);
  unlink("file");
  leave_folder();
}
int stat_of_small_files(const char* path, struct stat* state) __asm__("stat");
CASE(older_names_of_the_calls_tell_the_same) {
  static const char* const by_name[] = {"stat", "lstat", "stat64", "lstat64"};
  static const char* const old_by_name[] = {"__xstat", "__lxstat", "__xstat64", "__lxstat64"};
  static const char* const by_descriptor[] = {"fstat", "fstat64"};
  static const char* const old_by_descriptor[] = {"__fxstat", "__fxstat64"};
  static const char* const in_folder[] = {"fstatat", "fstatat64"};
  static const char* const old_in_folder[] = {"__fxstatat", "__fxstatat64"};
  const struct stat expected = state_of("/");
  const int descriptor = open("/", O_RDONLY);
  struct stat state = {0};
  EXPECT_IS(stat_of_small_files("/", &state), 0);
  EXPECT_IS(state.st_ino, expected.st_ino);
  for (int i = 0; i < 4; ++i) {
    EXPECT_IS(((int (*)(const char*, struct stat*))dlsym(RTLD_DEFAULT, by_name[i]))("/", &state), 0);
    EXPECT_IS(state.st_ino, expected.st_ino);
    memset(&state, 0, sizeof state);
    EXPECT_IS(((int (*)(int, const char*, struct stat*))dlsym(RTLD_DEFAULT, old_by_name[i]))(1, "/", &state), 0);
    EXPECT_IS(state.st_ino, expected.st_ino);
  }
  for (int i = 0; i < 2; ++i) {
    memset(&state, 0, sizeof state);
    EXPECT_IS(((int (*)(int, struct stat*))dlsym(RTLD_DEFAULT, by_descriptor[i]))(descriptor, &state), 0);
    EXPECT_IS(state.st_ino, expected.st_ino);
    memset(&state, 0, sizeof state);
    EXPECT_IS(((int (*)(int, int, struct stat*))dlsym(RTLD_DEFAULT, old_by_descriptor[i]))(1, descriptor, &state), 0);
    EXPECT_IS(state.st_ino, expected.st_ino);
    memset(&state, 0, sizeof state);
    EXPECT_IS(
        ((int (*)(int, const char*, struct stat*, int))dlsym(RTLD_DEFAULT, in_folder[i]))(AT_FDCWD, "/", &state, 0), 0);
    EXPECT_IS(state.st_ino, expected.st_ino);
    memset(&state, 0, sizeof state);
    EXPECT_IS(((int (*)(int, int, const char*, struct stat*, int))dlsym(RTLD_DEFAULT, old_in_folder[i]))(
                  1, AT_FDCWD, "/", &state, 0),
              0);
    EXPECT_IS(state.st_ino, expected.st_ino);
  }
  close(descriptor);
}
CASE(pipes_and_sockets_have_inodes_too) {
  struct stat first, second, third;
  char path[40], expected[40], link[40] = {0};
  int ends[2], sockets[2];
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, sockets), 0);
  EXPECT_IS(fstat(ends[0], &first), 0);
  EXPECT_IS(fstat(ends[1], &second), 0);
  EXPECT_IS(fstat(sockets[0], &third), 0);
  EXPECT_IS(first.st_ino, second.st_ino);
  EXPECT(S_ISFIFO(first.st_mode) && S_ISSOCK(third.st_mode));
  snprintf(path, sizeof path, "/proc/self/fd/%d", ends[0]);
  snprintf(expected, sizeof expected, "pipe:[%lu]", (unsigned long)first.st_ino);
  EXPECT_IS(readlink(path, link, sizeof link - 1), (long)strlen(expected));
  EXPECT_IS(strcmp(link, expected), 0);
  printf("%s %lu\n", link, (unsigned long)third.st_ino);
}
CASE(children_see_the_same_inodes) {
  enter_folder();
  make("file", "");
  const ino_t own = state_of("file").st_ino;
  const pid_t child = fork();
  if (child == 0) {
    make("late", "");
    printf("%lu\n", (unsigned long)state_of("late").st_ino);
    fflush(stdout);
    _exit(state_of("file").st_ino == own ? 0 : 1);
  }
  int status = 1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(status, 0);
  printf("%lu\n", (unsigned long)state_of("late").st_ino);
  unlink("file"), unlink("late");
  leave_folder();
}
CASE(a_file_that_is_not_there_is_an_error) {
  struct stat state;
  EXPECT_FAILS(stat("/no/such/file", &state), ENOENT);
  EXPECT_FAILS(fstat(-1, &state), EBADF);
  EXPECT_FAILS(fstat(777, &state), EBADF);
  EXPECT_FAILS(lstat("", &state), ENOENT);
  EXPECT_FAILS(fstatat(AT_FDCWD, "/", &state, 0x40000000), EINVAL);
}

static void expect_date(struct timespec date, long long after, long long before) {
  EXPECT(ns_of(date) >= after - tick_ns);
  EXPECT(ns_of(date) <= before);
}
CASE(a_file_has_the_date_of_its_making) {
  enter_folder();
  const long long before = now_ns(CLOCK_REALTIME);
  make("file", "x");
  const long long after = now_ns(CLOCK_REALTIME);
  sleep_ms(50);
  const struct stat state = state_of("file");
  expect_date(state.st_mtim, before, after);
  expect_date(state.st_ctim, before, after);
  printf("%lld %lld %lld\n", ns_of(state.st_mtim), ns_of(state.st_ctim), ns_of(state.st_atim));
  unlink("file");
  leave_folder();
}
CASE(a_stream_that_is_closed_gives_its_file_the_date) {
  enter_folder();
  FILE* const file = fopen("file", "w");
  sleep_ms(50);
  fputs("text", file);
  const long long before = now_ns(CLOCK_REALTIME);
  fclose(file);
  const long long after = now_ns(CLOCK_REALTIME);
  sleep_ms(50);
  expect_date(state_of("file").st_mtim, before, after);
  EXPECT_IS(state_of("file").st_size, 4);
  printf("%lld\n", ns_of(state_of("file").st_mtim));
  unlink("file");
  leave_folder();
}
CASE(a_later_change_gives_a_later_date) {
  enter_folder();
  make("file", "x");
  const long long first = ns_of(state_of("file").st_mtim);
  sleep_ms(50);
  make("file", "xy");
  const long long second = ns_of(state_of("file").st_mtim);
  EXPECT(second >= first + 40000000);
  sleep_ms(50);
  EXPECT_IS(chmod("file", 0600), 0);
  EXPECT_IS(ns_of(state_of("file").st_mtim), second);
  EXPECT(ns_of(state_of("file").st_ctim) >= second + 40000000);
  printf("%lld %lld\n", ns_of(state_of("file").st_mtim), ns_of(state_of("file").st_ctim));
  unlink("file");
  leave_folder();
}
CASE(a_folder_has_the_date_of_its_last_entry) {
  enter_folder();
  const long long first = ns_of(state_of(".").st_mtim);
  sleep_ms(50);
  make("file", "");
  const long long second = ns_of(state_of(".").st_mtim);
  EXPECT(second >= first + 40000000);
  sleep_ms(50);
  unlink("file");
  EXPECT(ns_of(state_of(".").st_mtim) >= second + 40000000);
  printf("%lld %lld\n", first, second);
  leave_folder();
}

static const struct timespec years_ago[2] = {{1000000000, 5}, {1100000000, 123456789}};
static void expect_years_ago(const char* name) {
  const struct stat state = state_of(name);
  EXPECT_IS(state.st_mtim.tv_sec, 1100000000);
  EXPECT_IS(state.st_atim.tv_sec, 1000000000);
}
CASE(dates_that_are_set_are_kept) {
  enter_folder();
  make("file", "");
  make("other", "");
  EXPECT_IS(symlink("file", "link"), 0);
  EXPECT_IS(utimensat(AT_FDCWD, "file", years_ago, 0), 0);
  expect_years_ago("file");
  EXPECT_IS(state_of("file").st_mtim.tv_nsec, 123456789);
  const int descriptor = open("other", O_RDONLY);
  EXPECT_IS(futimens(descriptor, years_ago), 0);
  expect_years_ago("other");
  const struct timeval times[2] = {{1000000000, 0}, {1100000000, 7}};
  EXPECT_IS(utimes("file", NULL), 0);
  EXPECT(state_of("file").st_mtim.tv_sec > 1600000000);
  EXPECT_IS(utimes("file", times), 0);
  expect_years_ago("file");
  EXPECT_IS(futimens(descriptor, NULL), 0);
  EXPECT_IS(futimes(descriptor, times), 0);
  expect_years_ago("other");
  EXPECT_IS(futimens(descriptor, NULL), 0);
  EXPECT_IS(futimesat(AT_FDCWD, "other", times), 0);
  expect_years_ago("other");
  const struct utimbuf seconds = {1000000000, 1100000000};
  EXPECT_IS(utime("other", NULL), 0);
  EXPECT_IS(utime("other", &seconds), 0);
  expect_years_ago("other");
  struct stat link;
  EXPECT_IS(lutimes("link", times), 0);
  EXPECT_IS(lstat("link", &link), 0);
  EXPECT_IS(link.st_mtim.tv_sec, 1100000000);
  close(descriptor);
  unlink("file"), unlink("other"), unlink("link");
  leave_folder();
}
CASE(the_present_date_can_be_set_and_left_out) {
  enter_folder();
  make("file", "");
  EXPECT_IS(utimensat(AT_FDCWD, "file", years_ago, 0), 0);
  const struct timespec times[2] = {{0, UTIME_OMIT}, {0, UTIME_NOW}};
  const long long before = now_ns(CLOCK_REALTIME);
  EXPECT_IS(utimensat(AT_FDCWD, "file", times, 0), 0);
  const struct stat state = state_of("file");
  EXPECT_IS(state.st_atim.tv_sec, 1000000000);
  expect_date(state.st_mtim, before, now_ns(CLOCK_REALTIME));
  EXPECT_FAILS(utimensat(AT_FDCWD, "none", times, 0), ENOENT);
  printf("%lld\n", ns_of(state.st_mtim));
  unlink("file");
  leave_folder();
}
CASE(dates_in_the_future_can_be_set) {
  enter_folder();
  make("file", "");
  const struct timespec far[2] = {{4000000000, 0}, {4000000001, 0}};
  EXPECT_IS(utimensat(AT_FDCWD, "file", far, 0), 0);
  EXPECT_IS(state_of("file").st_mtim.tv_sec, 4000000001);
  sleep_ms(20);
  make("file", "new");
  EXPECT(state_of("file").st_mtim.tv_sec < 4000000000);
  unlink("file");
  leave_folder();
}

static const char* const names[] = {"delta", "alpha", "Zeta", "charlie", "bravo", "9", ".hidden", "echo"};
enum { names_count = sizeof names / sizeof *names };
static void make_names(void) {
  for (int i = 0; i < names_count; ++i) make(names[i], "");
}
static void remove_names(void) {
  for (int i = 0; i < names_count; ++i) unlink(names[i]);
}
CASE(a_folder_has_each_entry_once_with_its_inode) {
  int seen[names_count] = {0}, all = 0;
  enter_folder();
  make_names();
  DIR* const directory = opendir(".");
  errno = 5;
  for (const struct dirent* entry; (entry = readdir(directory)) != NULL; ++all) {
    struct stat state;
    EXPECT_IS(lstat(entry->d_name, &state), 0);
    EXPECT_IS(entry->d_ino, state.st_ino);
    EXPECT(entry->d_type == DT_REG || entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN);
    for (int i = 0; i < names_count; ++i) seen[i] += strcmp(entry->d_name, names[i]) == 0;
    puts(entry->d_name);
  }
  EXPECT_IS(errno, 5);
  EXPECT_IS(all, names_count + 2);
  for (int i = 0; i < names_count; ++i) EXPECT_IS(seen[i], 1);
  EXPECT(readdir(directory) == NULL);
  EXPECT_IS(closedir(directory), 0);
  remove_names();
  leave_folder();
}
CASE(a_folder_can_be_read_again_and_from_a_position) {
  enter_folder();
  make_names();
  DIR* const directory = opendir(".");
  const char* first;
  char third[300];
  EXPECT((first = readdir(directory)->d_name) != NULL);
  char copy[300];
  strcpy(copy, first);
  EXPECT(readdir(directory) != NULL);
  const long position = telldir(directory);
  strcpy(third, readdir(directory)->d_name);
  while (readdir(directory) != NULL) continue;
  seekdir(directory, position);
  EXPECT_IS(strcmp(readdir(directory)->d_name, third), 0);
  make("new", "");
  rewinddir(directory);
  EXPECT_IS(strcmp(readdir(directory)->d_name, copy), 0);
  int found = 0;
  for (const struct dirent* entry; (entry = readdir(directory)) != NULL;) found += strcmp(entry->d_name, "new") == 0;
  EXPECT_IS(found, 1);
  closedir(directory);
  unlink("new");
  remove_names();
  leave_folder();
}
CASE(entries_can_be_read_into_memory_of_the_callers) {
  static const char* const calls[] = {"readdir_r", "readdir64_r"};
  enter_folder();
  make_names();
  for (int i = 0; i < 2; ++i) {
    int (*const read_entry)(DIR*, struct dirent*, struct dirent**) =
        (int (*)(DIR*, struct dirent*, struct dirent**))dlsym(RTLD_DEFAULT, calls[i]);
    DIR* const directory = opendir(".");
    struct dirent memory, *result = NULL;
    int all = 0;
    for (; EXPECT_IS(read_entry(directory, &memory, &result), 0), result != NULL; ++all) {
      EXPECT(result == &memory);
      puts(memory.d_name);
    }
    EXPECT_IS(all, names_count + 2);
    closedir(directory);
  }
  remove_names();
  leave_folder();
}
static int is_lower(const struct dirent* entry) { return entry->d_name[0] >= 'a'; }
CASE(a_scan_selects_and_sorts) {
  static const char* const calls[] = {"scandir", "scandir64"};
  struct dirent** found;
  enter_folder();
  make_names();
  for (int i = 0; i < 2; ++i) {
    typedef int (*Scan)(const char*, struct dirent***, int (*)(const struct dirent*),
                        int (*)(const struct dirent**, const struct dirent**));
    const int count = ((Scan)dlsym(RTLD_DEFAULT, calls[i]))(".", &found, is_lower, alphasort);
    EXPECT_IS(count, 5);
    EXPECT_IS(strcmp(found[0]->d_name, "alpha"), 0);
    EXPECT_IS(strcmp(found[4]->d_name, "echo"), 0);
    for (int k = 0; k < count; ++k) free(found[k]);
    free(found);
  }
  const int all = scandir(".", &found, NULL, NULL);
  EXPECT_IS(all, names_count + 2);
  for (int i = 0; i < all; ++i) puts(found[i]->d_name);
  EXPECT_IS(scandirat(AT_FDCWD, ".", &found, is_lower, NULL), 5);
  for (int i = 0; i < 5; ++i) puts(found[i]->d_name);
  EXPECT_IS(((int (*)(int, const char*, struct dirent***, void*, void*))dlsym(RTLD_DEFAULT, "scandirat"))(
                AT_FDCWD, ".", &found, NULL, NULL),
            names_count + 2);
  EXPECT_FAILS(scandir("/no/such/folder", &found, NULL, NULL), ENOENT);
  EXPECT_FAILS(scandirat(AT_FDCWD, "/no/such/folder", &found, NULL, NULL), ENOENT);
  remove_names();
  leave_folder();
}
CASE(processes_are_found_by_their_numbers) {
  char number[16], link[16] = {0}, path[32];
  int own = 0;
  snprintf(number, sizeof number, "%d", getpid());
  EXPECT_IS(readlink("/proc/self", link, sizeof link - 1), (long)strlen(number));
  EXPECT_IS(strcmp(link, number), 0);
  EXPECT_IS(readlinkat(AT_FDCWD, "/proc/self", link, 3), 3);
  DIR* const directory = opendir("/proc");
  for (const struct dirent* entry; (entry = readdir(directory)) != NULL;) own += strcmp(entry->d_name, number) == 0;
  EXPECT_IS(own, 1);
  closedir(directory);
  snprintf(path, sizeof path, "/proc/%d/exe", getpid());
  EXPECT_IS(access(path, R_OK), 0);
  EXPECT_IS(faccessat(AT_FDCWD, path, X_OK, 0), 0);
  char by_number[300] = {0}, by_name[300] = {0};
  EXPECT(readlink(path, by_number, sizeof by_number - 1) > 0);
  EXPECT(readlink("/proc/self/exe", by_name, sizeof by_name - 1) > 0);
  EXPECT_IS(strcmp(by_number, by_name), 0);
  EXPECT(S_ISDIR(state_of(by_name + 0).st_mode) == 0);
  snprintf(path, sizeof path, "/proc/%d", getpid());
  EXPECT(S_ISDIR(state_of(path).st_mode));
  DIR* const own_folder = opendir(path);
  EXPECT(own_folder != NULL);
  closedir(own_folder);
}
static void* nothing(void* unused) {
  let_others_wait();
  return unused;
}
CASE(threads_are_found_by_their_numbers) {
  const pthread_t other = start(nothing, NULL);
  DIR* const directory = opendir("/proc/self/task");
  int all = 0, own = 0;
  for (const struct dirent* entry; (entry = readdir(directory)) != NULL;) {
    if (entry->d_name[0] == '.') continue;
    ++all;
    own += atoi(entry->d_name) == gettid();
  }
  EXPECT_IS(all, 2);
  EXPECT_IS(own, 1);
  closedir(directory);
  join(other);
}
