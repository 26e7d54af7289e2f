// SPDX-License-Identifier: BSD-3-Clause
// Two or three threads, each of which makes a call on state that all share: pairs BUILD-UP CALL CALL [CALL] SAME FOLDER
// FILE.
//
// SAME is 1 if all calls are about the same object, else 0: then the second call is about another one. Each run that
// ends appends its outcome, a line, to FILE: the results of the calls, and the state that they leave. Build-up
// `native:ORDER` makes the calls in this order, as in `native:aba`, whose first thread makes its call twice; without
// the simulation, it is the oracle. `pairs` alone lists the calls with their groups.
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

static sem_t units[2];
static mqd_t queues[2];
static timer_t timers[2];
static int files[2], copies[2], events[2], ticks[2], watches[2], pipes[2][2], sockets[2][2];
static FILE* streams[2];
static pthread_t first_thread;
static pthread_once_t onces[2] = {PTHREAD_ONCE_INIT, PTHREAD_ONCE_INIT};
static pthread_mutex_t mutexes[2] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};
static char tokens[2][16];
static __thread int self;
static int winners[2];

static int or_error(long result) { return result < 0 ? -errno : (int)result; }
static char* named(int i, const char* name) {
  static __thread char text[4][64];
  static __thread int turn;
  char* const to = text[turn++ % 4];
  snprintf(to, 64, "%s%d", name, i);
  return to;
}
static void caught(int signal) { (void)signal; }

// A call a line.
// clang-format off

// Values of primitives, queues and timers.
static int sem_value(int i) { int value; sem_getvalue(&units[i], &value); return value; }
static int sem_give(int i) { return sem_post(&units[i]); }
static int sem_take(int i) { return or_error(sem_trywait(&units[i])); }
static int queue_count(int i) { struct mq_attr of; return mq_getattr(queues[i], &of) < 0 ? -errno : (int)of.mq_curmsgs; }
static int queue_send(int i) { return or_error(mq_send(queues[i], "m", 1, 0)); }
static int queue_take(int i) { char text[16]; return or_error(mq_receive(queues[i], text, sizeof text, NULL)); }
static int queue_flags(int i) { struct mq_attr to = {.mq_flags = 0}, old; return mq_setattr(queues[i], &to, &old) < 0 ? -errno : (int)old.mq_flags; }
static int timer_left(int i) { struct itimerspec of; return timer_gettime(timers[i], &of) < 0 ? -errno : (int)(of.it_value.tv_sec + 50) / 100; }
static int timer_set(int i) { const struct itimerspec to = {{0, 0}, {500, 0}}; return or_error(timer_settime(timers[i], 0, &to, NULL)); }
static int timer_remove(int i) { return or_error(timer_delete(timers[i])); }
static int alarm_set(int i) { return (int)(alarm(1000 + (unsigned)i * 1000) + 50) / 100; }
static int interval_left(int i) { struct itimerval of; (void)i; getitimer(ITIMER_REAL, &of); return (int)(of.it_value.tv_sec + 50) / 100; }
static int tick_set(int i) { const struct itimerspec to = {{0, 0}, {300, 0}}; return or_error(timerfd_settime(ticks[i], 0, &to, NULL)); }
static int tick_left(int i) { struct itimerspec of; return timerfd_gettime(ticks[i], &of) < 0 ? -errno : (int)(of.it_value.tv_sec + 50) / 100; }
static void win0(void) { winners[0] = self; }
static void win1(void) { winners[1] = self; }
static int once_call(int i) { pthread_once(&onces[i], i == 0 ? win0 : win1); return winners[i]; }
static int mutex_try(int i) { return pthread_mutex_trylock(&mutexes[i]); }

// Files.
static int file_pread(int i) { char text[9] = ""; return pread(files[i], text, 8, 0) < 0 ? -errno : text[0] * 256 + text[1]; }
static int file_pwrite(int i) { return or_error(pwrite(files[i], "xy", 2, 0)); }
static int file_read(int i) { char c = 0; return read(files[i], &c, 1) < 0 ? -errno : c; }
static int file_write(int i) { return or_error(write(files[i], self == 1 ? "1" : "2", 1)); }
static int file_seek(int i) { return or_error(lseek(files[i], 1, SEEK_CUR)); }
static int file_cut(int i) { return or_error(ftruncate(files[i], 1)); }
static int file_size(int i) { struct stat of; return fstat(files[i], &of) < 0 ? -errno : (int)of.st_size; }
static int copy_seek(int i) { return or_error(lseek(copies[i], 2, SEEK_CUR)); }
static int name_size(int i) { struct stat of; return stat(named(i, "f"), &of) < 0 ? -errno : (int)of.st_size; }
static int name_cut(int i) { return or_error(truncate(named(i, "f"), 2)); }
static int name_access(int i) { return or_error(access(named(i, "f"), F_OK)); }
static int name_remove(int i) { return or_error(unlink(named(i, "f"))); }
static int name_make(int i) { return open(named(i, "n"), O_CREAT | O_EXCL | O_WRONLY, 0666) < 0 ? -errno : 1; }
static int new_access(int i) { struct stat of; return stat(named(i, "n"), &of) < 0 ? -errno : (int)of.st_mode & 0777; }
static int name_move(int i) { return or_error(rename(named(i, "f"), named(i, "n"))); }
static int folder_make(int i) { return or_error(mkdir(named(i, "e"), 0777)); }
static int folder_remove(int i) { return or_error(rmdir(named(i, "d"))); }
static int folder_move(int i) { return or_error(rename(named(i, "d"), named(i, "e"))); }
static int file_in_folder(int i) { return open(strcat(named(i, "d"), "/x"), O_CREAT | O_WRONLY, 0600) < 0 ? -errno : 1; }
static int in_folder(int i) { return or_error(access(strcat(named(i, "d"), "/x"), F_OK)); }
static int folder_list(int i) { struct dirent** all; (void)i; const int count = scandir(".", &all, NULL, NULL); return or_error(count); }
static int name_link(int i) { return or_error(link(named(i, "f"), named(i, "n"))); }
static int name_symlink(int i) { return or_error(symlink(named(i, "f"), named(i, "n"))); }
static int name_readlink(int i) { char text[32]; return or_error(readlink(named(i, "n"), text, sizeof text)); }
static int name_chmod(int i) { return or_error(chmod(named(i, "f"), 0600)); }
static int name_mode(int i) { struct stat of; return stat(named(i, "f"), &of) < 0 ? -errno : (int)of.st_mode & 0777; }
static int name_times(int i) { const struct timespec to[2] = {{5, 0}, {7, 0}}; return or_error(utimensat(AT_FDCWD, named(i, "f"), to, 0)); }
static int name_date(int i) { struct stat of; return stat(named(i, "f"), &of) < 0 ? -errno : of.st_mtim.tv_sec == 7; }
static int file_lock(int i) { return or_error(flock(files[i], LOCK_EX | LOCK_NB)); }
static int other_lock(int i) { const int other = open(named(i, "f"), O_RDONLY); return other < 0 ? -errno : or_error(flock(other, LOCK_EX | LOCK_NB)); }

// Streams.
static int stream_seek(int i) { return fseek(streams[i], 1, SEEK_CUR); }
static int stream_tell(int i) { return or_error(ftell(streams[i])); }
static int stream_put(int i) { return fputc('p', streams[i]); }
static int stream_print(int i) { return fprintf(streams[i], "%s", "print"); }
static int stream_flush(int i) { return fflush(streams[i]); }

// Descriptors.
static int number_of_open(int i) { (void)i; return or_error(open("f0", O_RDONLY)); }
static int number_of_pipe(int i) { int ends[2]; (void)i; return pipe(ends) < 0 ? -errno : ends[0] * 100 + ends[1]; }
static int number_of_socket(int i) { (void)i; return or_error(socket(AF_UNIX, SOCK_STREAM, 0)); }
static int number_of_dup(int i) { return or_error(dup(files[i])); }
static int number_of_fopen(int i) { FILE* const opened = fopen(named(i, "f"), "r"); return opened == NULL ? -errno : fileno(opened); }
static int file_close(int i) { return or_error(close(files[i])); }
static int file_replace(int i) { return or_error(dup2(pipes[0][0], files[i])); }
static int flags_get(int i) { return or_error(fcntl(files[i], F_GETFL)) & (O_APPEND | O_NONBLOCK); }
static int flags_set(int i) { return or_error(fcntl(files[i], F_SETFL, O_APPEND)); }
static int close_on_exec(int i) { return or_error(fcntl(files[i], F_SETFD, FD_CLOEXEC)); }
static int is_close_on_exec(int i) { return or_error(fcntl(files[i], F_GETFD)); }
static int pipe_count(int i) { int count = 0; return ioctl(pipes[i][0], FIONREAD, &count) < 0 ? -errno : count; }
static int pipe_write(int i) { return or_error(write(pipes[i][1], "abc", 3)); }
static int pipe_read(int i) { char text[8]; return or_error(read(pipes[i][0], text, sizeof text)); }
static int pipe_close(int i) { return or_error(close(pipes[i][1])); }
static int pipe_shut(int i) { return or_error(close(pipes[i][0])); }
static int pipe_poll(int i) { struct pollfd one = {pipes[i][0], POLLIN, 0}; poll(&one, 1, 0); return one.revents; }
static int event_write(int i) { return or_error(eventfd_write(events[i], 2)); }
static int event_read(int i) { eventfd_t value = 0; return eventfd_read(events[i], &value) < 0 ? -errno : (int)value; }
static int watch_add(int i) { struct epoll_event of = {EPOLLIN, {.fd = 5}}; return or_error(epoll_ctl(watches[i], EPOLL_CTL_ADD, pipes[i][0], &of)); }
static int watch_look(int i) { struct epoll_event of; return or_error(epoll_wait(watches[i], &of, 1, 0)); }
static int socket_send(int i) { return or_error(send(sockets[i][0], "abcd", 4, MSG_NOSIGNAL)); }
static int socket_take(int i) { char text[8]; return or_error(recv(sockets[i][1], text, sizeof text, MSG_DONTWAIT)); }
static int socket_shut(int i) { return or_error(shutdown(sockets[i][0], SHUT_WR)); }
static int socket_option(int i) { const int to = 1; return or_error(setsockopt(sockets[i][1], SOL_SOCKET, SO_PASSCRED, &to, sizeof to)); }
static int socket_option_get(int i) { int of = 0; socklen_t size = sizeof of; return getsockopt(sockets[i][1], SOL_SOCKET, SO_PASSCRED, &of, &size) < 0 ? -errno : of; }

// The process and its threads.
static int variable_get(int i) { const char* const value = getenv(named(i, "V")); return value == NULL ? -1 : value[0]; }
static int variable_set(int i) { return setenv(named(i, "V"), self == 1 ? "x" : "y", 1); }
static int variable_unset(int i) { return unsetenv(named(i, "V")); }
static int folder_enter(int i) { return or_error(chdir(named(i, "d"))); }
static int folder_now(int i) { char path[512] = ""; (void)i; if (getcwd(path, sizeof path) == NULL) return -errno; return path[strlen(path) - 2] == 'd'; }
static int mask_set(int i) { (void)i; return (int)umask(self == 1 ? 077 : 027); }
static int action_set(int i) { struct sigaction to = {.sa_handler = self == 1 ? caught : SIG_IGN}, old; sigaction(SIGUSR2 + i, &to, &old); return old.sa_handler == SIG_DFL ? 0 : old.sa_handler == SIG_IGN ? 1 : 2; }
static int action_get(int i) { struct sigaction old; sigaction(SIGUSR2 + i, NULL, &old); return old.sa_handler == SIG_DFL ? 0 : old.sa_handler == SIG_IGN ? 1 : 2; }
static int mask_block(int i) { sigset_t to; (void)i; sigemptyset(&to); sigaddset(&to, SIGUSR1); return pthread_sigmask(SIG_BLOCK, &to, NULL); }
static int signal_pends(int i) { sigset_t of; (void)i; sigpending(&of); return sigismember(&of, SIGTERM); }
static int signal_send(int i) { (void)i; return kill(getpid(), SIGTERM); }
static int thread_name(int i) { char name[16] = ""; (void)i; pthread_getname_np(first_thread, name, sizeof name); return name[0]; }
static int thread_rename(int i) { (void)i; return pthread_setname_np(first_thread, self == 1 ? "one" : "two"); }
static int random_draw(int i) { (void)i; return rand() & 0xFFFF; }
static int random_seed(int i) { (void)i; srand((unsigned)self); return 0; }
static int random_bytes(int i) { unsigned char byte = 0; (void)i; return getrandom(&byte, 1, 0) < 0 ? -errno : byte; }
static int token_next(int i) { const char* const token = strtok(i == 0 && tokens[0][0] == 'p' ? NULL : tokens[i], ","); return token == NULL ? -1 : token[0]; }
static int limit_get(int i) { struct rlimit of; (void)i; getrlimit(RLIMIT_CORE, &of); return (int)(of.rlim_cur & 0xFFFF); }
static int limit_set(int i) { const struct rlimit to = {0, RLIM_INFINITY}; (void)i; return or_error(setrlimit(RLIMIT_CORE, &to)); }
static int key_make(int i) { pthread_key_t key = 0; (void)i; return pthread_key_create(&key, NULL) != 0 ? -1 : (int)key; }
static int semaphore_open(int i) { sem_t* const opened = sem_open(named(i, "/pairs"), O_CREAT | O_EXCL, 0600, 1); return opened == SEM_FAILED ? -errno : 1; }
static int semaphore_unlink(int i) { return or_error(sem_unlink(named(i, "/pairs"))); }
static int nothing(int i) { (void)i; return 0; }
// clang-format on

struct call {
  const char *group, *name;
  int (*make)(int i);
};
#define CALL(group, name) \
  { group, #name, name }
// clang-format off
static const struct call calls[] = {
    CALL("values", sem_value), CALL("values", sem_give), CALL("values", sem_take), CALL("values", queue_count),
    CALL("values", queue_send), CALL("values", queue_take), CALL("values", queue_flags), CALL("values", timer_left),
    CALL("values", timer_set), CALL("values", timer_remove), CALL("values", alarm_set), CALL("values", interval_left),
    CALL("values", tick_set), CALL("values", tick_left), CALL("values", once_call), CALL("values", mutex_try),
    CALL("files", file_pread), CALL("files", file_pwrite), CALL("files", file_read), CALL("files", file_write),
    CALL("files", file_seek), CALL("files", file_cut), CALL("files", file_size), CALL("files", copy_seek),
    CALL("files", name_size), CALL("files", name_cut), CALL("files", name_access), CALL("files", name_remove),
    CALL("files", name_make), CALL("files", new_access), CALL("files", name_move), CALL("files", folder_make),
    CALL("files", folder_remove), CALL("files", folder_move), CALL("files", file_in_folder), CALL("files", in_folder),
    CALL("files", folder_list), CALL("files", name_link), CALL("files", name_symlink), CALL("files", name_readlink),
    CALL("files", name_chmod), CALL("files", name_mode), CALL("files", name_times), CALL("files", name_date),
    CALL("files", file_lock), CALL("files", other_lock), CALL("files", file_close), CALL("files", mask_set),
    CALL("files", folder_enter), CALL("files", stream_flush), CALL("files", stream_print),
    CALL("streams", stream_seek), CALL("streams", stream_tell), CALL("streams", stream_put),
    CALL("streams", stream_print), CALL("streams", stream_flush), CALL("streams", file_size),
    CALL("descriptors", number_of_open), CALL("descriptors", number_of_pipe), CALL("descriptors", number_of_socket),
    CALL("descriptors", number_of_dup), CALL("descriptors", number_of_fopen), CALL("descriptors", file_close),
    CALL("descriptors", file_replace), CALL("descriptors", file_size), CALL("descriptors", file_read),
    CALL("descriptors", flags_get), CALL("descriptors", flags_set), CALL("descriptors", close_on_exec),
    CALL("descriptors", is_close_on_exec), CALL("descriptors", pipe_count), CALL("descriptors", pipe_write),
    CALL("descriptors", pipe_read), CALL("descriptors", pipe_close), CALL("descriptors", pipe_shut),
    CALL("descriptors", pipe_poll), CALL("descriptors", event_write), CALL("descriptors", event_read),
    CALL("descriptors", watch_add), CALL("descriptors", watch_look), CALL("descriptors", socket_send),
    CALL("descriptors", socket_take), CALL("descriptors", socket_shut), CALL("descriptors", socket_option),
    CALL("descriptors", socket_option_get), CALL("descriptors", tick_left), CALL("descriptors", other_lock),
    CALL("process", variable_get), CALL("process", variable_set), CALL("process", variable_unset),
    CALL("process", folder_enter), CALL("process", folder_now), CALL("process", name_access),
    CALL("process", mask_set), CALL("process", name_make), CALL("process", action_set), CALL("process", action_get),
    CALL("process", mask_block), CALL("process", signal_pends), CALL("process", signal_send),
    CALL("process", thread_name), CALL("process", thread_rename), CALL("process", random_draw),
    CALL("process", random_seed), CALL("process", random_bytes), CALL("process", token_next),
    CALL("process", limit_get), CALL("process", limit_set), CALL("process", key_make),
    CALL("process", semaphore_open), CALL("process", semaphore_unlink), CALL("process", nothing),
};
// clang-format on
enum { calls_count = sizeof calls / sizeof *calls };

static const struct call* find(const char* name) {
  for (int i = 0; i < calls_count; ++i)
    if (strcmp(calls[i].name, name) == 0) return &calls[i];
  fprintf(stderr, "pairs: unknown call %s\n", name);
  exit(2);
}

static const struct call* made[3];
static int objects_of[3], calls_made = 2, repeats = 1, is_once, is_pending, results[3][4], counts[3];
static const char* order;  // null: as the threads are scheduled
static sem_t turns[3], made_one;
static pthread_once_t once_before = PTHREAD_ONCE_INIT;
static pthread_mutex_t between = PTHREAD_MUTEX_INITIALIZER;
static int first_of_once;

static void note_first(void) { first_of_once = self; }

static void make_one(int which) { results[which][counts[which]++] = made[which]->make(objects_of[which]); }
// Of the first thread, which may not have begun.
static void in_handler(int signal) {
  (void)signal;
  self = 1;
  make_one(0);
}

static void* run(void* argument) {
  const int which = (int)(long)argument;
  self = which + 1;
  while (order != NULL) {
    while (sem_wait(&turns[which]) != 0) {
    }
    make_one(which);
    sem_post(&made_one);
  }
  if (is_pending && which == 0)
    while (sem_wait(&turns[0]) != 0) {
    }
  if (is_once) pthread_once(&once_before, note_first);
  const int times = which == 0 ? repeats : 1;
  for (int i = 0; i < times; ++i) make_one(which);
  return NULL;
}

static void make_in_order(void) {
  self = 2;
  for (const char* at = order; *at != '\0'; ++at) {
    if (*at == 'b') {
      make_one(1);
      continue;
    }
    sem_post(&turns[*at - 'a']);
    while (sem_wait(&made_one) != 0) {
    }
  }
}

static void* run_between(void* argument) {
  pthread_mutex_lock(&between);
  pthread_mutex_unlock(&between);
  return argument;
}

static void set_up(const char* folder) {
  unsigned hash = 0;
  for (const char* at = folder; *at != '\0'; ++at) hash = hash * 31 + (unsigned char)*at;
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, NULL);
  umask(022);
  first_thread = pthread_self();
  pthread_setname_np(first_thread, "main");
  for (int i = 0; i < 2; ++i) {
    unlink(named(i, "f")), unlink(named(i, "n")), unlink(named(i, "s"));
    unlink(strcat(named(i, "d"), "/x")), unlink(strcat(named(i, "e"), "/x")), unlink(strcat(named(i, "d"), "/n0"));
    unlink(strcat(named(i, "d"), "/n1")), rmdir(named(i, "d")), rmdir(named(i, "e")), mkdir(named(i, "d"), 0755);
  }
  for (int i = 0; i < 2; ++i) {
    sem_init(&units[i], 0, 1);
    files[i] = open(named(i, "f"), O_RDWR | O_CREAT, 0644);
    if (files[i] < 0 || write(files[i], "abcdef", 6) != 6 || lseek(files[i], 0, SEEK_SET) != 0) abort();
    copies[i] = dup(files[i]);
    streams[i] = fopen(named(i, "s"), "w+");
    if (streams[i] == NULL) abort();
    fputs("stream", streams[i]), rewind(streams[i]);
    const struct mq_attr of = {.mq_maxmsg = 4, .mq_msgsize = 16};
    char name[64];
    snprintf(name, sizeof name, "/pairs-%x-%d", hash, i);  // the machine's other runs have others
    queues[i] = mq_open(name, O_RDWR | O_CREAT | O_NONBLOCK, 0600, &of);
    if (queues[i] < 0) abort();
    mq_unlink(name), mq_send(queues[i], "m", 1, 0);
    struct sigevent none = {.sigev_notify = SIGEV_NONE};
    timer_create(CLOCK_MONOTONIC, &none, &timers[i]);
    ticks[i] = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK);
    events[i] = eventfd(1, EFD_NONBLOCK);
    watches[i] = epoll_create1(0);
    if (pipe2(pipes[i], O_NONBLOCK) != 0 || socketpair(AF_UNIX, SOCK_STREAM, 0, sockets[i]) != 0) abort();
    if (write(pipes[i][1], "z", 1) != 1) abort();
    strcpy(tokens[i], i == 0 ? "a,b,c" : "d,e,f");
    setenv(named(i, "V"), "v", 1);
    sem_unlink(named(i, "/pairs"));
  }
  for (int i = 0; i < 3; ++i) sem_init(&turns[i], 0, 0);
  sem_init(&made_one, 0, 0);
  signal(SIGPIPE, SIG_IGN);
}

static void print_outcome(const char* file) {
  char text[2048];
  int size = 0;
  for (int which = 0; which < calls_made; ++which)
    for (int i = 0; i < counts[which] && i < 3; ++i)
      size += snprintf(text + size, sizeof text - (size_t)size, "%c=%d ", 'a' + which, results[which][i]);
  size += snprintf(text + size, sizeof text - (size_t)size, "once=%d cwd=%d ", first_of_once, folder_now(0));
  for (int i = 0; i < 2; ++i) {
    struct sigaction action;
    sigaction(SIGUSR2 + i, NULL, &action);
    size +=
        snprintf(text + size, sizeof text - (size_t)size,
                 "| sem %d queue %d %d timer %d tick %d file %d %d %d name %d new %d flags %d %d pipe %d action %d "
                 "variable %d offset %d stream %d ",
                 sem_value(i), queue_count(i), queue_flags(i), timer_left(i), tick_left(i), file_size(i), file_pread(i),
                 name_mode(i), name_size(i), new_access(i), flags_get(i), is_close_on_exec(i), pipe_count(i),
                 action.sa_handler == SIG_DFL   ? 0
                 : action.sa_handler == SIG_IGN ? 1
                                                : 2,
                 variable_get(i), (int)lseek(files[i], 0, SEEK_CUR), stream_tell(i));
  }
  size += snprintf(text + size, sizeof text - (size_t)size, "mask %o name %c limit %d\n", umask(0), thread_name(0),
                   limit_get(0));
  const int out = open(file, O_WRONLY | O_CREAT | O_APPEND, 0644);
  if (out < 0 || write(out, text, (size_t)size) != size) abort();
  _exit(0);
}

int main(int count, char** arguments) {
  if (count == 1) {
    for (int i = 0; i < calls_count; ++i) printf("%s %s\n", calls[i].group, calls[i].name);
    return 0;
  }
  if (count != 7 && count != 8) return 2;
  calls_made = count - 5;
  const char *const build_up = arguments[1], *const file = arguments[count - 1];
  for (int i = 0; i < calls_made; ++i) made[i] = find(arguments[2 + i]);
  objects_of[1] = arguments[count - 3][0] == '0';
  if (chdir(arguments[count - 2]) != 0) return 2;
  set_up(arguments[count - 2]);
  pthread_t threads[3];
  if (strncmp(build_up, "native:", 7) == 0) order = build_up + 7;
  if (strcmp(build_up, "twice") == 0) repeats = 2;
  is_once = strcmp(build_up, "once") == 0;
  is_pending = strcmp(build_up, "pending") == 0;
  if (is_pending) repeats = 0, signal(SIGUSR1, in_handler);
  const int has_third = strcmp(build_up, "third") == 0;
  pthread_create(&threads[0], NULL, run, (void*)0L);
  if (is_pending) pthread_kill(threads[0], SIGUSR1), sem_post(&turns[0]);
  if (calls_made == 3) pthread_create(&threads[2], NULL, run, (void*)2L);
  if (has_third) {
    pthread_create(&threads[2], NULL, run_between, NULL);
    pthread_create(&threads[1], NULL, run, (void*)1L);
    pthread_join(threads[2], NULL), pthread_join(threads[1], NULL);
  } else if (order != NULL) {
    make_in_order();
    print_outcome(file);
  } else {
    run((void*)1L);  // few threads have few schedules
  }
  pthread_join(threads[0], NULL);
  if (calls_made == 3) pthread_join(threads[2], NULL);
  print_outcome(file);
}
