// SPDX-License-Identifier: BSD-3-Clause
// System V semaphores, shared memory and message queues shared by a process and its children.
#include "tests/exec/conformance/harness.h"

#include <signal.h>
#include <sys/ipc.h>
#include <sys/msg.h>
#include <sys/sem.h>
#include <sys/shm.h>
#include <sys/wait.h>

static int semaphores, segment = -1, queue = -1;
static void remove_all(void) {
  semctl(semaphores, 0, IPC_RMID);
  if (segment >= 0) shmctl(segment, IPC_RMID, NULL);
  if (queue >= 0) msgctl(queue, IPC_RMID, NULL);
}
static void make_semaphores(int count) {
  semaphores = semget(IPC_PRIVATE, count, 0600);
  EXPECT(semaphores >= 0);
}
static int change(int number, int by, int flags) {
  struct sembuf operation = {(unsigned short)number, (short)by, (short)flags};
  return semop(semaphores, &operation, 1);
}
static void expect_end_of(pid_t child, int status) {
  int ended = -1;
  EXPECT_IS(waitpid(child, &ended, 0), child);
  EXPECT(WIFEXITED(ended));
  EXPECT_IS(WEXITSTATUS(ended), status);
}

CASE(a_child_gives_what_its_parent_waits_for) {
  make_semaphores(1);
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(20);
    _exit(change(0, 1, 0) == 0 ? 3 : 1);
  }
  EXPECT_IS(change(0, -1, 0), 0);
  EXPECT_IS(semctl(semaphores, 0, GETVAL), 0);
  expect_end_of(child, 3);
  remove_all();
}
CASE(a_parent_gives_what_its_child_waits_for) {
  make_semaphores(1);
  const pid_t child = fork();
  if (child == 0) _exit(change(0, -1, 0) == 0 ? 3 : 1);
  while (semctl(semaphores, 0, GETNCNT) == 0) sleep_ms(1);
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(semctl(semaphores, 0, GETVAL), 0);  // handed over
  expect_end_of(child, 3);
  remove_all();
}
CASE(processes_take_turns) {
  make_semaphores(2);
  const pid_t child = fork();
  if (child == 0) {
    for (int i = 0; i < 50; ++i) {
      EXPECT_IS(change(0, -1, 0), 0);
      EXPECT_IS(change(1, 1, 0), 0);
    }
    _exit(3);
  }
  for (int i = 0; i < 50; ++i) {
    EXPECT_IS(change(0, 1, 0), 0);
    EXPECT_IS(change(1, -1, 0), 0);
  }
  expect_end_of(child, 3);
  remove_all();
}
CASE(zero_is_waited_for_between_processes) {
  make_semaphores(1);
  EXPECT_IS(semctl(semaphores, 0, SETVAL, 1), 0);
  const pid_t child = fork();
  if (child == 0) _exit(change(0, 0, 0) == 0 ? 3 : 1);
  while (semctl(semaphores, 0, GETZCNT) == 0) sleep_ms(1);
  EXPECT_IS(semctl(semaphores, 0, SETVAL, 0), 0);
  expect_end_of(child, 3);
  remove_all();
}
CASE(what_a_child_has_done_is_undone_at_its_end) {
  make_semaphores(1);
  EXPECT_IS(semctl(semaphores, 0, SETVAL, 1), 0);
  const pid_t child = fork();
  if (child == 0) {
    EXPECT_IS(change(0, -1, SEM_UNDO), 0);
    for (;;) pause();
  }
  while (semctl(semaphores, 0, GETVAL) != 0) sleep_ms(1);
  EXPECT_IS(kill(child, SIGKILL), 0);
  EXPECT_IS(change(0, -1, 0), 0);
  waitpid(child, NULL, 0);
  remove_all();
}
CASE(removal_ends_the_wait_of_a_child) {
  make_semaphores(1);
  const pid_t child = fork();
  if (child == 0) _exit(change(0, -1, 0) == -1 && errno == EIDRM ? 3 : 1);
  while (semctl(semaphores, 0, GETNCNT) == 0) sleep_ms(1);
  remove_all();
  expect_end_of(child, 3);
}
CASE(the_last_process_is_told) {
  make_semaphores(1);
  const pid_t child = fork();
  if (child == 0) _exit(change(0, 1, 0) == 0 ? 3 : 1);
  expect_end_of(child, 3);
  EXPECT_IS(semctl(semaphores, 0, GETPID), child);
  EXPECT_IS(semctl(semaphores, 0, GETVAL), 1);
  remove_all();
}
CASE(a_set_that_a_child_made_is_there_after_it) {
  const key_t key = 0x57500000 + getpid();
  const pid_t child = fork();
  if (child == 0) {
    semaphores = semget(key, 1, IPC_CREAT | IPC_EXCL | 0600);
    _exit(semaphores >= 0 && semctl(semaphores, 0, SETVAL, 5) == 0 ? 3 : 1);
  }
  expect_end_of(child, 3);
  semaphores = semget(key, 1, 0600);
  EXPECT(semaphores >= 0);
  EXPECT_IS(semctl(semaphores, 0, GETVAL), 5);
  remove_all();
}
CASE(threads_of_both_processes_wait_for_one_set) {
  make_semaphores(1);
  const pid_t child = fork();
  if (child == 0) _exit(change(0, -2, 0) == 0 ? 3 : 1);
  while (semctl(semaphores, 0, GETNCNT) == 0) sleep_ms(1);
  EXPECT_IS(change(0, 1, 0), 0);
  EXPECT_IS(change(0, 1, 0), 0);
  expect_end_of(child, 3);
  EXPECT_IS(semctl(semaphores, 0, GETVAL), 0);
  remove_all();
}

CASE(memory_that_a_child_made_is_its_parents_too) {
  make_semaphores(1);
  const key_t key = 0x57510000 + getpid();
  const pid_t child = fork();
  if (child == 0) {
    const int made = shmget(key, 10000, IPC_CREAT | IPC_EXCL | 0600);
    char* const bytes = shmat(made, NULL, 0);
    EXPECT(bytes != (char*)-1);
    strcpy(bytes + 9000, "from the child");
    _exit(3);
  }
  expect_end_of(child, 3);
  segment = shmget(key, 0, 0);
  EXPECT(segment >= 0);
  const char* const bytes = shmat(segment, NULL, 0);
  EXPECT(strcmp(bytes + 9000, "from the child") == 0);
  EXPECT_IS(bytes[0], 0);
  struct shmid_ds status;
  EXPECT_IS(shmctl(segment, IPC_STAT, &status), 0);
  EXPECT_IS(status.shm_nattch, 1);
  EXPECT_IS(status.shm_cpid, child);
  remove_all();
}
CASE(a_child_inherits_what_is_attached) {
  make_semaphores(1);
  segment = shmget(IPC_PRIVATE, 100, 0600);
  int* const shared = shmat(segment, NULL, 0);
  const pid_t child = fork();
  if (child == 0) {
    *shared = 5;
    EXPECT_IS(change(0, 1, 0), 0);
    for (;;) pause();
  }
  EXPECT_IS(change(0, -1, 0), 0);
  EXPECT_IS(*shared, 5);
  struct shmid_ds status;
  EXPECT_IS(shmctl(segment, IPC_STAT, &status), 0);
  EXPECT_IS(status.shm_nattch, 2);
  kill(child, SIGKILL);
  waitpid(child, NULL, 0);
  EXPECT_IS(shmctl(segment, IPC_STAT, &status), 0);
  EXPECT_IS(status.shm_nattch, 1);
  remove_all();
}
CASE(memory_of_a_segment_that_was_there_before_is_zero_again) {
  make_semaphores(1);
  for (int i = 0; i < 3; ++i) {
    segment = shmget(IPC_PRIVATE, 8192, 0600);
    char* const bytes = shmat(segment, NULL, 0);
    EXPECT_IS(bytes[0], 0);
    EXPECT_IS(bytes[8191], 0);
    memset(bytes, 7, 8192);
    EXPECT_IS(shmctl(segment, IPC_RMID, NULL), 0);
    EXPECT_IS(shmdt(bytes), 0);
  }
  segment = -1;
  remove_all();
}

struct letter {
  long type;
  char text[32];
};
CASE(messages_go_between_processes) {
  make_semaphores(1);
  queue = msgget(IPC_PRIVATE, 0600);
  const pid_t child = fork();
  struct letter letter;
  if (child == 0) {
    EXPECT_IS(msgrcv(queue, &letter, sizeof letter.text, 5, 0), 6);
    strcat(letter.text, " again");
    letter.type = 6;
    EXPECT_IS(msgsnd(queue, &letter, strlen(letter.text) + 1, 0), 0);
    _exit(3);
  }
  sleep_ms(10);
  letter.type = 5;
  strcpy(letter.text, "hello");
  EXPECT_IS(msgsnd(queue, &letter, 6, 0), 0);
  EXPECT_IS(msgrcv(queue, &letter, sizeof letter.text, 6, 0), 12);
  EXPECT(strcmp(letter.text, "hello again") == 0);
  expect_end_of(child, 3);
  struct msqid_ds status;
  EXPECT_IS(msgctl(queue, IPC_STAT, &status), 0);
  EXPECT_IS(status.msg_lspid, child);
  EXPECT_IS(status.msg_lrpid, getpid());
  EXPECT_IS(status.msg_qnum, 0);
  remove_all();
}
CASE(a_child_makes_room_for_its_parent) {
  make_semaphores(1);
  queue = msgget(IPC_PRIVATE, 0600);
  static struct {
    long type;
    char bytes[8192];
  } large = {1, {0}};
  EXPECT_IS(msgsnd(queue, &large, 8192, 0), 0);
  EXPECT_IS(msgsnd(queue, &large, 8192, 0), 0);
  const pid_t child = fork();
  if (child == 0) {
    sleep_ms(20);
    _exit(msgrcv(queue, &large, 8192, 0, 0) == 8192 ? 3 : 1);
  }
  EXPECT_IS(msgsnd(queue, &large, 1, 0), 0);
  expect_end_of(child, 3);
  remove_all();
}
CASE(a_message_is_not_lost_with_a_process_that_is_killed) {
  make_semaphores(1);
  queue = msgget(IPC_PRIVATE, 0600);
  const pid_t child = fork();
  struct letter letter = {1, "x"};
  if (child == 0) {
    EXPECT_IS(change(0, 1, 0), 0);
    msgrcv(queue, &letter, 1, 0, 0);
    _exit(1);
  }
  EXPECT_IS(change(0, -1, 0), 0);
  sleep_ms(10);
  kill(child, SIGKILL);
  waitpid(child, NULL, 0);
  EXPECT_IS(msgsnd(queue, &letter, 1, 0), 0);
  EXPECT_IS(msgrcv(queue, &letter, 1, 0, IPC_NOWAIT), 1);
  remove_all();
}
