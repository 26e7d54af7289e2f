// SPDX-License-Identifier: BSD-3-Clause
// Every cancellation point: with the cancellation pending before the call, and during its wait.
#undef _FILE_OFFSET_BITS  // distinguishes names with and without a size
#include "tests/exec/conformance/harness.h"

#include <aio.h>
#include <fcntl.h>
#include <mqueue.h>
#include <poll.h>
#include <semaphore.h>
#include <signal.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/msg.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <termios.h>

static char bytes[1 << 20];
static int ends[2], pair[2], file = -1;

static void open_all(void) {
  char path[] = "/tmp/waitpoint-cancellation-XXXXXX";
  file = mkstemp(path);
  EXPECT(file >= 0 && unlink(path) == 0);
  EXPECT_IS(pipe(ends), 0);
  EXPECT_IS(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
}
static mqd_t queue(void) {
  char name[32];
  sprintf(name, "/waitpoint-points-%d", getpid());
  const mqd_t made = mq_open(name, O_CREAT | O_RDWR, 0600, NULL);
  EXPECT(made >= 0 && mq_unlink(name) == 0);
  return made;
}
static sigset_t only(int signal) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  return set;
}
static sem_t semaphore_of(unsigned count) {
  sem_t made;
  EXPECT_IS(sem_init(&made, 0, count), 0);
  return made;
}

static char path_of_fifo[64];
static const char* fifo(void) {
  sprintf(path_of_fifo, "/tmp/waitpoint-cancellation-%d", getpid());
  EXPECT_IS(mkfifo(path_of_fifo, 0600), 0);
  return path_of_fifo;
}
static int messages_id = -1;
static int messages(void) { return messages_id = msgget(IPC_PRIVATE, 0600); }

static int is_cleaned, came_back;
static void clean(void* unused) {
  (void)unused;
  if (path_of_fifo[0] != '\0') unlink(path_of_fifo);
  if (messages_id >= 0) msgctl(messages_id, IPC_RMID, NULL);
  is_cleaned = 1;
}
static void (*call)(void);

static void* call_cancelled(void* unused) {
  pthread_cleanup_push(clean, NULL);
  EXPECT_IS(pthread_cancel(pthread_self()), 0);
  call();
  came_back = 1;
  pthread_cleanup_pop(0);
  return unused;
}
static void* call_it(void* unused) {
  pthread_cleanup_push(clean, NULL);
  call();
  came_back = 1;
  pthread_cleanup_pop(0);
  return unused;
}
static void expect_left(pthread_t id) {
  EXPECT(join(id) == PTHREAD_CANCELED);
  EXPECT_IS(is_cleaned, 1);
  EXPECT_IS(came_back, 0);
}

#define CANCELLED_BEFORE(name, ...)              \
  static void call_##name(void) { __VA_ARGS__; } \
  CASE(cancelled_before_##name) {                \
    open_all();                                  \
    call = call_##name;                          \
    expect_left(start(call_cancelled, NULL));    \
  }
#define CANCELLED_WITHIN(name, ...)                 \
  static void wait_in_##name(void) { __VA_ARGS__; } \
  CASE(cancelled_within_##name) {                   \
    open_all();                                     \
    call = wait_in_##name;                          \
    const pthread_t id = start(call_it, NULL);      \
    sleep_ms(20);                                   \
    EXPECT_IS(pthread_cancel(id), 0);               \
    expect_left(id);                                \
  }

CANCELLED_BEFORE(read_pipe, read(ends[0], bytes, 1))
CANCELLED_BEFORE(read_file, read(file, bytes, 1))
CANCELLED_BEFORE(write_file, (void)!write(file, bytes, 1))
CANCELLED_BEFORE(write_pipe, (void)!write(ends[1], bytes, 1))
CANCELLED_BEFORE(readv_file, struct iovec v = {bytes, 1}; readv(file, &v, 1))
CANCELLED_BEFORE(writev_file, struct iovec v = {bytes, 1}; (void)!writev(file, &v, 1))
CANCELLED_BEFORE(pread, (void)!pread(file, bytes, 1, 0))
CANCELLED_BEFORE(pread64, (void)!pread64(file, bytes, 1, 0))
CANCELLED_BEFORE(pwrite, (void)!pwrite(file, bytes, 1, 0))
CANCELLED_BEFORE(pwrite64, (void)!pwrite64(file, bytes, 1, 0))
CANCELLED_BEFORE(preadv, struct iovec v = {bytes, 1}; preadv(file, &v, 1, 0))
CANCELLED_BEFORE(pwritev, struct iovec v = {bytes, 1}; pwritev(file, &v, 1, 0))
CANCELLED_BEFORE(preadv2, struct iovec v = {bytes, 1}; preadv2(file, &v, 1, 0, 0))
CANCELLED_BEFORE(pwritev2, struct iovec v = {bytes, 1}; pwritev2(file, &v, 1, 0, 0))
CANCELLED_BEFORE(preadv64, struct iovec v = {bytes, 1}; preadv64(file, &v, 1, 0))
CANCELLED_BEFORE(pwritev64, struct iovec v = {bytes, 1}; pwritev64(file, &v, 1, 0))
CANCELLED_BEFORE(preadv64v2, struct iovec v = {bytes, 1}; preadv64v2(file, &v, 1, 0, 0))
CANCELLED_BEFORE(pwritev64v2, struct iovec v = {bytes, 1}; pwritev64v2(file, &v, 1, 0, 0))
CANCELLED_BEFORE(lockf64, (void)!lockf64(file, F_LOCK, 0))
CANCELLED_BEFORE(fsync, fsync(file))
CANCELLED_BEFORE(fdatasync, fdatasync(file))
CANCELLED_BEFORE(sync_file_range, sync_file_range(file, 0, 1, 0))
CANCELLED_BEFORE(fallocate, fallocate(file, 0, 0, 1))
CANCELLED_BEFORE(fallocate64, fallocate64(file, 0, 0, 1))
CANCELLED_BEFORE(msync, void* m = mmap(0, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
                 msync(m, 4096, MS_SYNC))
CANCELLED_BEFORE(open, open("/dev/null", O_RDONLY))
CANCELLED_BEFORE(open64, open64("/dev/null", O_RDONLY))
CANCELLED_BEFORE(openat, openat(AT_FDCWD, "/dev/null", O_RDONLY))
CANCELLED_BEFORE(creat, creat("/dev/null", 0600))
CANCELLED_BEFORE(creat64, creat64("/dev/null", 0600))
CANCELLED_BEFORE(close, close(ends[0]))
CANCELLED_BEFORE(close_file, close(file))
CANCELLED_BEFORE(fcntl_setlkw, struct flock l = {.l_type = F_WRLCK}; fcntl(file, F_SETLKW, &l))
CANCELLED_BEFORE(lockf, (void)!lockf(file, F_LOCK, 0))
CANCELLED_BEFORE(tcdrain, tcdrain(file))
CANCELLED_BEFORE(sleep, sleep(1))
CANCELLED_BEFORE(sleep_0, sleep(0))
CANCELLED_BEFORE(usleep, usleep(1000))
CANCELLED_BEFORE(nanosleep, sleep_ms(1))
CANCELLED_BEFORE(clock_nanosleep, struct timespec t = {0, 1000}; clock_nanosleep(CLOCK_MONOTONIC, 0, &t, NULL))
CANCELLED_BEFORE(poll, poll(NULL, 0, 1))
CANCELLED_BEFORE(poll_0, poll(NULL, 0, 0))
CANCELLED_BEFORE(ppoll, struct timespec t = {0, 1000}; ppoll(NULL, 0, &t, NULL))
CANCELLED_BEFORE(select, struct timeval t = {0, 1000}; select(0, NULL, NULL, NULL, &t))
CANCELLED_BEFORE(pselect, struct timespec t = {0, 1000}; pselect(0, NULL, NULL, NULL, &t, NULL))
CANCELLED_BEFORE(epoll_wait, struct epoll_event e; int d = epoll_create1(0); epoll_wait(d, &e, 1, 1))
CANCELLED_BEFORE(epoll_pwait, struct epoll_event e; int d = epoll_create1(0); epoll_pwait(d, &e, 1, 1, NULL))
CANCELLED_BEFORE(recv, recv(pair[0], bytes, 1, 0))
CANCELLED_BEFORE(recvfrom, recvfrom(pair[0], bytes, 1, 0, NULL, NULL))
CANCELLED_BEFORE(recvmsg, struct iovec v = {bytes, 1}; struct msghdr m = {.msg_iov = &v, .msg_iovlen = 1};
                 recvmsg(pair[0], &m, 0))
CANCELLED_BEFORE(send, send(pair[0], bytes, 1, 0))
CANCELLED_BEFORE(sendto, sendto(pair[0], bytes, 1, 0, NULL, 0))
CANCELLED_BEFORE(sendmsg, struct iovec v = {bytes, 1}; struct msghdr m = {.msg_iov = &v, .msg_iovlen = 1};
                 sendmsg(pair[0], &m, 0))
CANCELLED_BEFORE(accept, int s = socket(AF_INET, SOCK_STREAM, 0); listen(s, 1); accept(s, NULL, NULL))
CANCELLED_BEFORE(connect, int s = socket(AF_UNIX, SOCK_STREAM, 0);
                 struct sockaddr_un a = {.sun_family = AF_UNIX, .sun_path = "/nonexistent"};
                 connect(s, (struct sockaddr*)&a, sizeof a))
CANCELLED_BEFORE(wait, wait(NULL))
CANCELLED_BEFORE(waitpid, waitpid(-1, NULL, 0))
CANCELLED_BEFORE(waitpid_nohang, waitpid(-1, NULL, WNOHANG))
CANCELLED_BEFORE(waitid, siginfo_t i; waitid(P_ALL, 0, &i, WEXITED))
CANCELLED_BEFORE(waitid_nohang, siginfo_t i; waitid(P_ALL, 0, &i, WEXITED | WNOHANG))
CANCELLED_BEFORE(wait4, wait4(-1, NULL, 0, NULL))
CANCELLED_BEFORE(pause, pause())
CANCELLED_BEFORE(sigsuspend, sigset_t s; sigemptyset(&s); sigsuspend(&s))
CANCELLED_BEFORE(sigwait, const sigset_t s = only(SIGUSR1); int n; sigwait(&s, &n))
CANCELLED_BEFORE(sigwaitinfo, const sigset_t s = only(SIGUSR1); sigwaitinfo(&s, NULL))
CANCELLED_BEFORE(sigtimedwait, const sigset_t s = only(SIGUSR1); struct timespec t = {0, 0}; sigtimedwait(&s, NULL, &t))
CANCELLED_BEFORE(system, (void)!system("true"))
CANCELLED_BEFORE(sem_wait_free, sem_t s = semaphore_of(1); sem_wait(&s))
CANCELLED_BEFORE(sem_timedwait_free, sem_t s = semaphore_of(1); struct timespec t = in_ms(CLOCK_REALTIME, 100);
                 sem_timedwait(&s, &t))
CANCELLED_BEFORE(cond_wait, pthread_mutex_t m = PTHREAD_MUTEX_INITIALIZER; pthread_cond_t c = PTHREAD_COND_INITIALIZER;
                 pthread_mutex_lock(&m); pthread_cond_wait(&c, &m))
CANCELLED_BEFORE(cond_timedwait_past, pthread_mutex_t m = PTHREAD_MUTEX_INITIALIZER;
                 pthread_cond_t c = PTHREAD_COND_INITIALIZER; struct timespec t = in_ms(CLOCK_REALTIME, 50);
                 pthread_mutex_lock(&m); pthread_cond_timedwait(&c, &m, &t))
CANCELLED_BEFORE(msgrcv, msgrcv(messages(), bytes, 10, 0, 0))
CANCELLED_BEFORE(msgsnd, *(long*)bytes = 1; msgsnd(messages(), bytes, 10, 0))
CANCELLED_BEFORE(mq_send, const mqd_t q = queue(); mq_send(q, bytes, 1, 0))
CANCELLED_BEFORE(mq_receive, const mqd_t q = queue(); mq_receive(q, bytes, 8192, 0))
CANCELLED_BEFORE(aio_suspend, struct aiocb c = {.aio_fildes = ends[0], .aio_buf = bytes, .aio_nbytes = 1};
                 const struct aiocb* l[] = {&c}; aio_read(&c); aio_suspend(l, 1, NULL))
CANCELLED_BEFORE(splice, splice(ends[0], NULL, ends[1], NULL, 1, 0))
CANCELLED_BEFORE(tee, tee(ends[0], ends[1], 1, 0))
CANCELLED_BEFORE(recvmmsg, struct iovec v = {bytes, 1};
                 struct mmsghdr m = {.msg_hdr = {.msg_iov = &v, .msg_iovlen = 1}}; recvmmsg(pair[0], &m, 1, 0, NULL))

CANCELLED_WITHIN(read, read(ends[0], bytes, 1))
CANCELLED_WITHIN(readv, struct iovec v = {bytes, 1}; readv(ends[0], &v, 1))
CANCELLED_WITHIN(write, for (;;)(void) !write(ends[1], bytes, sizeof bytes))
CANCELLED_WITHIN(writev, struct iovec v = {bytes, sizeof bytes}; for (;;)(void) !writev(ends[1], &v, 1))
CANCELLED_WITHIN(recv, recv(pair[0], bytes, 1, 0))
CANCELLED_WITHIN(recvmsg, struct iovec v = {bytes, 1}; struct msghdr m = {.msg_iov = &v, .msg_iovlen = 1};
                 recvmsg(pair[0], &m, 0))
CANCELLED_WITHIN(send, for (;;) send(pair[0], bytes, sizeof bytes, 0))
CANCELLED_WITHIN(accept, int s = socket(AF_INET, SOCK_STREAM, 0); listen(s, 1); accept(s, NULL, NULL))
CANCELLED_WITHIN(open_fifo, open(fifo(), O_RDONLY))
CANCELLED_WITHIN(pause, pause())
CANCELLED_WITHIN(sigsuspend, sigset_t s; sigemptyset(&s); sigsuspend(&s))
CANCELLED_WITHIN(sigwaitinfo, const sigset_t s = only(SIGUSR1); sigwaitinfo(&s, NULL))
CANCELLED_WITHIN(poll, poll(NULL, 0, 3000))
CANCELLED_WITHIN(select, select(0, NULL, NULL, NULL, NULL))
CANCELLED_WITHIN(pselect, fd_set s; FD_ZERO(&s); FD_SET(ends[0], &s); pselect(ends[0] + 1, &s, NULL, NULL, NULL, NULL))
CANCELLED_WITHIN(epoll, struct epoll_event e; int d = epoll_create1(0); epoll_wait(d, &e, 1, -1))
CANCELLED_WITHIN(system, (void)!system("sleep 2"))
CANCELLED_WITHIN(
    waitpid, pid_t c = fork(); if (c == 0) {
      sleep(1);
      _exit(0);
    } waitpid(c, NULL, 0))
CANCELLED_WITHIN(aio_suspend, struct aiocb c = {.aio_fildes = ends[0], .aio_buf = bytes, .aio_nbytes = 1};
                 const struct aiocb* l[] = {&c}; aio_read(&c); aio_suspend(l, 1, NULL))
CANCELLED_WITHIN(msgrcv, msgrcv(messages(), bytes, 10, 0, 0))
CANCELLED_WITHIN(mq_receive, const mqd_t q = queue(); mq_receive(q, bytes, 8192, 0))
CANCELLED_WITHIN(ofd_lock, struct flock l = {.l_type = F_WRLCK}; char n[32]; sprintf(n, "/proc/self/fd/%d", file);
                 int g = open(n, O_RDWR); fcntl(file, F_OFD_SETLK, &l); fcntl(g, F_OFD_SETLKW, &l))
CANCELLED_WITHIN(splice, splice(ends[0], NULL, pair[1], NULL, 1, 0))
CANCELLED_WITHIN(eventfd_read, eventfd_t v; int d = eventfd(0, 0); eventfd_read(d, &v))
