// SPDX-License-Identifier: BSD-3-Clause
// Named semaphores.
#include "tests/exec/conformance/harness.h"

#include <fcntl.h>
#include <grp.h>
#include <limits.h>
#include <semaphore.h>
#include <stdint.h>
#include <sys/stat.h>

static char name[64];
static void take_away(void) { sem_unlink(name); }

/// A name unique to this process.
static const char* own_name(void) {
  snprintf(name, sizeof name, "/conformance-%d", (int)getpid());
  sem_unlink(name);
  atexit(take_away);
  return name;
}
static int value_of(sem_t* semaphore) {
  int value = -77;
  EXPECT_IS(sem_getvalue(semaphore, &value), 0);
  return value;
}
static void expect_no(sem_t* semaphore, int number) {
  EXPECT(semaphore == SEM_FAILED);
  EXPECT_IS(errno, number);
}

CASE(open_makes_one_with_its_count) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 4);
  EXPECT(semaphore != SEM_FAILED);
  EXPECT_IS(value_of(semaphore), 4);
  EXPECT_IS(sem_wait(semaphore), 0);
  EXPECT_IS(value_of(semaphore), 3);
  EXPECT_IS(sem_close(semaphore), 0);
}
CASE(one_that_exists_keeps_its_count) {
  sem_t* const first = sem_open(own_name(), O_CREAT, 0600, 4);
  sem_t* const second = sem_open(name, O_CREAT, 0600, 9);
  EXPECT_IS(value_of(second), 4);
  sem_post(first);
  EXPECT_IS(value_of(second), 5);
}
CASE(one_name_is_at_one_address) {
  sem_t* const first = sem_open(own_name(), O_CREAT, 0600, 1);
  EXPECT(first == sem_open(name, 0));
}
CASE(it_is_kept_while_nobody_has_it_open) {
  sem_t* semaphore = sem_open(own_name(), O_CREAT, 0600, 1);
  sem_post(semaphore);
  EXPECT_IS(sem_close(semaphore), 0);
  semaphore = sem_open(name, 0);
  EXPECT(semaphore != SEM_FAILED);
  EXPECT_IS(value_of(semaphore), 2);
}
CASE(exclusive_creation_refuses_one_that_exists) {
  sem_open(own_name(), O_CREAT, 0600, 1);
  expect_no(sem_open(name, O_CREAT | O_EXCL, 0600, 1), EEXIST);
}
CASE(exclusive_creation_makes_a_new_one) { EXPECT(sem_open(own_name(), O_CREAT | O_EXCL, 0600, 1) != SEM_FAILED); }
CASE(one_that_is_not_there_is_not_opened) { expect_no(sem_open(own_name(), 0), ENOENT); }
CASE(open_refuses_a_count_above_SEM_VALUE_MAX) {
  expect_no(sem_open(own_name(), O_CREAT, 0600, SEM_VALUE_MAX + 1U), EINVAL);
}
CASE(open_refuses_an_empty_name) {
  expect_no(sem_open("/", O_CREAT, 0600, 1), EINVAL);
  expect_no(sem_open("", O_CREAT, 0600, 1), EINVAL);
}
CASE(open_refuses_a_name_with_folders) { expect_no(sem_open("/conformance/name", O_CREAT, 0600, 1), EINVAL); }
CASE(open_refuses_a_name_that_is_too_long) {
  static char text[NAME_MAX + 50];
  memset(text, 'x', sizeof text - 1);
  text[0] = '/';
  EXPECT(sem_open(text, O_CREAT, 0600, 1) == SEM_FAILED);
  EXPECT(errno == ENAMETOOLONG || errno == EINVAL);
}
CASE(a_name_may_lack_its_slash) {
  own_name();
  sem_t* const semaphore = sem_open(name + 1, O_CREAT, 0600, 1);
  EXPECT(semaphore != SEM_FAILED);
  EXPECT(semaphore == sem_open(name + 1, 0));
  EXPECT_IS(sem_unlink(name + 1), 0);
}
CASE(unlink_takes_the_name_away) {
  sem_open(own_name(), O_CREAT, 0600, 1);
  EXPECT_IS(sem_unlink(name), 0);
  expect_no(sem_open(name, 0), ENOENT);
  EXPECT_FAILS(sem_unlink(name), ENOENT);
}
CASE(unlink_refuses_what_is_no_name) {
  EXPECT_FAILS(sem_unlink("/"), ENOENT);
  EXPECT_FAILS(sem_unlink("/conformance/name"), ENOENT);
}
CASE(an_unlinked_one_can_still_be_used) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 0);
  sem_unlink(name);
  EXPECT_IS(sem_post(semaphore), 0);
  EXPECT_IS(sem_wait(semaphore), 0);
  EXPECT_IS(sem_close(semaphore), 0);
}
CASE(a_new_one_of_an_unlinked_name_is_another) {
  sem_t* const first = sem_open(own_name(), O_CREAT, 0600, 5);
  sem_unlink(name);
  sem_t* const second = sem_open(name, O_CREAT, 0600, 7);
  EXPECT(first != second);
  EXPECT_IS(value_of(first), 5);
  EXPECT_IS(value_of(second), 7);
}
CASE(close_refuses_one_without_a_name) {
  sem_t semaphore;
  sem_init(&semaphore, 0, 1);
  EXPECT_FAILS(sem_close(&semaphore), EINVAL);
}
CASE(each_open_wants_its_close) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 1);
  sem_open(name, 0);
  EXPECT_IS(sem_close(semaphore), 0);
  EXPECT_IS(value_of(semaphore), 1);
  EXPECT_IS(sem_close(semaphore), 0);
  EXPECT_FAILS(sem_close(semaphore), EINVAL);
}

static void* open_and_take(void* unused) {
  sem_t* const semaphore = sem_open(name, 0);
  EXPECT(semaphore != SEM_FAILED);
  EXPECT_IS(sem_wait(semaphore), 0);
  note("taken");
  sem_close(semaphore);
  return unused;
}
CASE(threads_meet_at_a_name) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 0);
  const pthread_t id = start(open_and_take, NULL);
  let_others_wait();
  note("posted ");
  EXPECT_IS(sem_post(semaphore), 0);
  join(id);
  EXPECT_NOTED("posted taken");
}
CASE(a_timed_wait_at_a_name_times_out) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 0);
  const struct timespec soon = in_ms(CLOCK_REALTIME, 3);
  EXPECT_FAILS(sem_timedwait(semaphore, &soon), ETIMEDOUT);
  EXPECT_FAILS(sem_trywait(semaphore), EAGAIN);
}

// Access, for another user: only root can become one.
static int become_another_user(void) {
  if (geteuid() != 0) return 0;
  EXPECT_IS(setgroups(0, NULL), 0);
  EXPECT_IS(setegid(65534), 0);
  EXPECT_IS(seteuid(65534), 0);
  return 1;
}
static void become_root_again(void) {
  EXPECT_IS(seteuid(0), 0);
  EXPECT_IS(setegid(0), 0);
}
CASE(the_mode_keeps_other_users_out) {
  EXPECT(sem_open(own_name(), O_CREAT, 0600, 1) != SEM_FAILED);
  if (!become_another_user()) return;
  expect_no(sem_open(name, 0), EACCES);
  expect_no(sem_open(name, O_CREAT, 0666, 1), EACCES);
  expect_no(sem_open(name, O_CREAT | O_EXCL, 0666, 1), EEXIST);
  become_root_again();
  EXPECT(sem_open(name, 0) != SEM_FAILED);
}
CASE(the_mode_lets_other_users_in) {
  umask(0);
  EXPECT(sem_open(own_name(), O_CREAT, 0606, 1) != SEM_FAILED);
  if (!become_another_user()) return;
  EXPECT(sem_open(name, 0) != SEM_FAILED);
  become_root_again();
}
CASE(to_read_it_is_not_enough) {
  umask(0);
  EXPECT(sem_open(own_name(), O_CREAT, 0604, 1) != SEM_FAILED);
  if (!become_another_user()) return;
  expect_no(sem_open(name, 0), EACCES);
  become_root_again();
}
CASE(the_mask_of_files_keeps_other_users_out) {
  umask(077);
  EXPECT(sem_open(own_name(), O_CREAT, 0666, 1) != SEM_FAILED);
  if (!become_another_user()) return;
  expect_no(sem_open(name, 0), EACCES);
  become_root_again();
}
CASE(other_users_cannot_unlink_it) {
  umask(0);
  EXPECT(sem_open(own_name(), O_CREAT, 0666, 1) != SEM_FAILED);
  if (!become_another_user()) return;
  EXPECT_FAILS(sem_unlink(name), EACCES);
  become_root_again();
  EXPECT_IS(sem_unlink(name), 0);
}
CASE(an_owner_without_rights_is_kept_out) {
  own_name();
  if (!become_another_user()) return;
  EXPECT(sem_open(name, O_CREAT, 0, 1) != SEM_FAILED);
  expect_no(sem_open(name, 0), EACCES);
  EXPECT_IS(sem_unlink(name), 0);
  become_root_again();
}
CASE(an_open_one_can_be_used_by_who_could_not_open_it) {
  sem_t* const semaphore = sem_open(own_name(), O_CREAT, 0600, 1);
  if (!become_another_user()) return;
  EXPECT_IS(sem_wait(semaphore), 0);
  EXPECT_IS(sem_post(semaphore), 0);
  become_root_again();
}
