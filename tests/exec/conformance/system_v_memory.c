// SPDX-License-Identifier: BSD-3-Clause
// System V shared memory.
#include "tests/exec/conformance/harness.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <sys/wait.h>

static int segment = -1;
static char* const failed = (char*)-1;

static int make(size_t size) {
  segment = shmget(IPC_PRIVATE, size, IPC_CREAT | 0600);
  EXPECT(segment >= 0);
  return segment;
}
static int unmake(void) { return shmctl(segment, IPC_RMID, NULL); }
static struct shmid_ds status_of(int id) {
  struct shmid_ds status;
  EXPECT_IS(shmctl(id, IPC_STAT, &status), 0);
  return status;
}
static key_t some_key(void) { return (key_t)(0x58000000 | (getpid() & 0xFFFFFF)); }

CASE(a_segment_begins_with_zeros) {
  make(10000);
  const char* const bytes = shmat(segment, NULL, 0);
  EXPECT(bytes != failed);
  for (int i = 0; i < 10000; ++i) EXPECT_IS(bytes[i], 0);
  EXPECT_IS(shmdt(bytes), 0);
  EXPECT_IS(unmake(), 0);
}
CASE(attachments_show_the_same_bytes) {
  make(4096);
  char* const one = shmat(segment, NULL, 0);
  char* const other = shmat(segment, NULL, 0);
  EXPECT(one != failed && other != failed && one != other);
  strcpy(one, "written");
  EXPECT_IS(strcmp(other, "written"), 0);
  EXPECT_IS(shmdt(one), 0);
  EXPECT_IS(strcmp(other, "written"), 0);
  EXPECT_IS(shmdt(other), 0);
  unmake();
}
CASE(what_was_written_stays_without_attachments) {
  make(100);
  char* bytes = shmat(segment, NULL, 0);
  strcpy(bytes, "kept");
  EXPECT_IS(shmdt(bytes), 0);
  bytes = shmat(segment, NULL, 0);
  EXPECT_IS(strcmp(bytes, "kept"), 0);
  EXPECT_IS(shmdt(bytes), 0);
  unmake();
}
static void* write_by_key(void* unused) {
  const int id = shmget(some_key(), 0, 0);
  EXPECT(id >= 0);
  char* const bytes = shmat(id, NULL, 0);
  strcpy(bytes, "by a thread");
  EXPECT_IS(shmdt(bytes), 0);
  return unused;
}
CASE(a_key_leads_to_the_same_segment) {
  segment = shmget(some_key(), 5000, IPC_CREAT | 0600);
  EXPECT_IS(shmget(some_key(), 5000, IPC_CREAT | 0600), segment);
  EXPECT_IS(shmget(some_key(), 100, 0600), segment);
  EXPECT_FAILS(shmget(some_key(), 5001, 0600), EINVAL);
  EXPECT_FAILS(shmget(some_key(), 5000, IPC_CREAT | IPC_EXCL | 0600), EEXIST);
  join(start(write_by_key, NULL));
  char* const bytes = shmat(segment, NULL, 0);
  EXPECT_IS(strcmp(bytes, "by a thread"), 0);
  shmdt(bytes);
  EXPECT_IS(unmake(), 0);
  EXPECT_FAILS(shmget(some_key(), 0, 0600), ENOENT);
}
CASE(get_refuses_no_bytes) { EXPECT_FAILS(shmget(IPC_PRIVATE, 0, 0600), EINVAL); }
CASE(attaching_takes_the_address_that_is_asked_for) {
  make(8192);
  char* const room = mmap(NULL, 65536, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  EXPECT_IS(munmap(room, 65536), 0);
  EXPECT(shmat(segment, room + 8192, 0) == room + 8192);
  EXPECT(shmat(segment, room + 20481, SHM_RND) == room + 20480);
  errno = 0;
  EXPECT(shmat(segment, room + 1, 0) == failed && errno == EINVAL);
  errno = 0;
  EXPECT(shmat(segment, room + 8192, 0) == failed && errno == EINVAL);  // already mapped
  EXPECT(shmat(segment, room + 8192, SHM_REMAP) == room + 8192);
  EXPECT_IS(shmdt(room + 8192), 0);
  EXPECT_IS(shmdt(room + 20480), 0);
  unmake();
}
CASE(attaching_and_detaching_refuse_what_is_not_there) {
  errno = 0;
  EXPECT(shmat(-1, NULL, 0) == failed && errno == EINVAL);
  make(1);
  EXPECT_FAILS(shmdt(&segment), EINVAL);
  EXPECT_FAILS(shmctl(segment, 4711, NULL), EINVAL);
  unmake();
  errno = 0;
  EXPECT(shmat(segment, NULL, 0) == failed && errno == EINVAL);
  EXPECT_FAILS(unmake(), EINVAL);
}
static void leave_with_3(int unused) {
  (void)unused;
  _exit(3);
}
CASE_ENDING_WITH(3, what_is_attached_for_reading_cannot_be_written) {
  make(100);
  char* const bytes = shmat(segment, NULL, SHM_RDONLY);
  EXPECT(bytes != failed);
  EXPECT_IS(bytes[5], 0);
  unmake();
  signal(SIGSEGV, leave_with_3);
  *(volatile char*)bytes = 1;
}
CASE(a_removed_segment_stays_until_the_last_detachment) {
  make(100);
  char* const bytes = shmat(segment, NULL, 0);
  EXPECT_IS(unmake(), 0);
  strcpy(bytes, "still there");
  const struct shmid_ds status = status_of(segment);
  EXPECT_IS(status.shm_nattch, 1);
  EXPECT((status.shm_perm.mode & SHM_DEST) != 0);
  EXPECT_IS(shmdt(bytes), 0);
  EXPECT_FAILS(shmctl(segment, IPC_STAT, (struct shmid_ds*)&status), EINVAL);
}
CASE(its_status_is_told) {
  const long long before = now_ns(CLOCK_REALTIME) / 1000000000;
  segment = shmget(some_key(), 5000, IPC_CREAT | 0640);
  struct shmid_ds status = status_of(segment);
  EXPECT_IS(status.shm_segsz, 5000);
  EXPECT_IS(status.shm_cpid, getpid());
  EXPECT_IS(status.shm_lpid, 0);
  EXPECT_IS(status.shm_nattch, 0);
  EXPECT_IS(status.shm_atime, 0);
  EXPECT_IS(status.shm_dtime, 0);
  EXPECT(status.shm_ctime >= before - 1);
  EXPECT_IS(status.shm_perm.mode & 0777, 0640);
  EXPECT_IS(status.shm_perm.__key, some_key());
  EXPECT_IS(status.shm_perm.uid, geteuid());
  char* const bytes = shmat(segment, NULL, 0);
  status = status_of(segment);
  EXPECT_IS(status.shm_nattch, 1);
  EXPECT_IS(status.shm_lpid, getpid());
  EXPECT(status.shm_atime >= before - 1);
  shmdt(bytes);
  status = status_of(segment);
  EXPECT_IS(status.shm_nattch, 0);
  EXPECT(status.shm_dtime >= before - 1);
  unmake();
}
CASE(its_mode_can_be_set) {
  make(1);
  struct shmid_ds status = status_of(segment);
  status.shm_perm.mode = 0444;
  EXPECT_IS(shmctl(segment, IPC_SET, &status), 0);
  EXPECT_IS(status_of(segment).shm_perm.mode & 0777, 0444);
  unmake();
}
CASE(it_can_be_locked) {
  make(1);
  EXPECT_IS(shmctl(segment, SHM_LOCK, NULL), 0);
  EXPECT((status_of(segment).shm_perm.mode & SHM_LOCKED) != 0);
  EXPECT_IS(shmctl(segment, SHM_UNLOCK, NULL), 0);
  EXPECT((status_of(segment).shm_perm.mode & SHM_LOCKED) == 0);
  unmake();
}
CASE(rights_are_those_of_the_mode) {
  make(1);
  struct shmid_ds status;
  if (geteuid() == 0) EXPECT_IS(seteuid(12345), 0);
  if (geteuid() == 12345) {  // neither owner nor in the group
    errno = 0;
    EXPECT(shmat(segment, NULL, 0) == failed && errno == EACCES);
    EXPECT_FAILS(shmctl(segment, IPC_STAT, &status), EACCES);
    EXPECT_FAILS(unmake(), EPERM);
    EXPECT_IS(seteuid(0), 0);
  }
  EXPECT_IS(unmake(), 0);
}
CASE(a_child_shares_the_bytes) {
  make(100);
  volatile char* const bytes = shmat(segment, NULL, 0);
  const pid_t child = fork();
  if (child == 0) {
    bytes[0] = 'c';
    _exit(0);
  }
  int status = -1;
  EXPECT_IS(waitpid(child, &status, 0), child);
  EXPECT_IS(status, 0);
  EXPECT_IS(bytes[0], 'c');
  EXPECT_IS(shmdt((void*)bytes), 0);
  unmake();
}
CASE(its_limits_are_told) {
  struct shminfo limits;
  EXPECT(shmctl(0, IPC_INFO, (struct shmid_ds*)(void*)&limits) >= 0);
  EXPECT(limits.shmmin == 1 && limits.shmmni >= 128);
  make(1);
  struct shm_info use;
  EXPECT(shmctl(0, SHM_INFO, (struct shmid_ds*)(void*)&use) >= 0);
  EXPECT(use.used_ids >= 1);
  unmake();
}
