// SPDX-License-Identifier: BSD-3-Clause
// A program of program.hpp on POSIX threads: program TEXT FILE.
//
// Each run appends a record to FILE, in shared memory, so that it is known however the run ends. An atomic is the
// offset of an open file, which lseek() reads, sets and adds to; if it is only read and set, the second one is a
// variable of the environment. One that is replaced if it is 0, which no call does, is plain memory: the post of a
// semaphore before each access is its switch point.
#include <fcntl.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum { threads_max = 4, objects = 2, reads_max = 12, page = 4096 };

// As in recorded_run.hpp.
struct Record {
  int ending;  // 0: none yet; else 'd' all ended, 'k' or 'm': ended or misused by `by`
  int by;
  int values[objects];
  int owners[objects];  // of the mutexes, counted from 1
  struct {
    int is_created, has_ended;
    int step, object;  // in progress
    int count, reads[reads_max];
  } threads[threads_max];
};

static struct Record* record;
static const char* texts[threads_max];
static pthread_t threads[threads_max];
static pthread_mutex_t mutexes[objects] = {PTHREAD_MUTEX_INITIALIZER, PTHREAD_MUTEX_INITIALIZER};
static pthread_cond_t conditions[objects] = {PTHREAD_COND_INITIALIZER, PTHREAD_COND_INITIALIZER};
static sem_t units[objects], turn;
static int files[objects];  // of atomics that are offsets
static int is_variable;     // the second atomic
static const char* const numerals[] = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};

static void end(int how, int by) {
  if (record->ending == 0) {
    record->ending = how;
    record->by = by;
  }
  _exit(0);
}

// An event that ends the program.
static void end_now(int how, int by) {
  sem_post(&turn);
  end(how, by);
}

static void end_normally(void) { end('d', 0); }

static void* run(void* argument);

static void start(int which) {
  record->threads[which].is_created = 1;
  if (pthread_create(&threads[which], NULL, run, (void*)(long)which) != 0) abort();
}

static void add_read(int self, int value) {
  if (record->threads[self].count < reads_max) record->threads[self].reads[record->threads[self].count++] = value;
}

static void access_offset(int self, char step, int object, int operand) {
  const long offset = lseek(files[object], step == 'g' ? 0 : operand, step == 'p' ? SEEK_SET : SEEK_CUR);
  record->values[object] = (int)offset;
  if (step != 'p') add_read(self, (int)offset - (step == 'f' ? operand : 0));
}

static void access_variable(int self, char step, int operand) {
  const char* const value = step == 'p' ? (setenv("VALUE", numerals[operand], 1), numerals[operand]) : getenv("VALUE");
  if (step == 'p') record->values[1] = operand;
  if (step == 'g') add_read(self, value[0] - '0');
}

// An atomic's operation, after its switch point.
static void access_atomic(int self, char step, int object, int operand) {
  if (is_variable && object == 1) return access_variable(self, step, operand);
  if (files[object] > 0) return access_offset(self, step, object, operand);
  sem_post(&turn);
  const int before = record->values[object];
  if (step != 'p') add_read(self, before);
  if (step == 'p' || (step == 'x' && before == 0)) record->values[object] = operand;
  if (step == 'f') record->values[object] = before + operand;
}

static struct timespec after(int seconds) {
  struct timespec time;
  clock_gettime(CLOCK_REALTIME, &time);
  time.tv_sec += seconds;
  return time;
}

static int lock_before(int mutex, struct timespec deadline) {
  return pthread_mutex_timedlock(&mutexes[mutex], &deadline) == 0;
}
static int wait_before(int condition, struct timespec deadline) {
  return pthread_cond_timedwait(&conditions[condition], &mutexes[condition], &deadline) == 0;
}
static int units_of(int semaphore) {
  int value = 0;
  sem_getvalue(&units[semaphore], &value);
  return value;
}
static int acquire_before(int semaphore, struct timespec deadline) {
  return sem_timedwait(&units[semaphore], &deadline) == 0;
}

// `held`: the mutexes of this thread.
static void use_mutex(int self, char step, int object, int operand, int* held) {
  const int is_try = step == 't' || step == 'L';
  if (is_try ? held[object] : step != 'l' && !held[object]) end_now('m', self);
  switch (step) {
    case 'l':
      pthread_mutex_lock(&mutexes[object]);
      held[object] = 1;
      break;
    case 't':
      held[object] = pthread_mutex_trylock(&mutexes[object]) == 0;
      add_read(self, held[object]);
      break;
    case 'u':
      held[object] = 0;
      pthread_mutex_unlock(&mutexes[object]);
      if (record->owners[object] == self + 1) record->owners[object] = 0;
      break;
    case 'L':
      held[object] = lock_before(object, after(operand));
      add_read(self, held[object]);
      break;
    case 'W':
      record->owners[object] = 0;
      add_read(self, wait_before(object, after(operand)));
      break;
    default: record->owners[object] = 0; pthread_cond_wait(&conditions[object], &mutexes[object]);
  }
  if (held[object]) record->owners[object] = self + 1;
}

static void execute(int self, char step, int object, int operand, int* created, int* held) {
  const struct timespec span = {operand > 0 ? operand : 1, 0};
  switch (step) {
    case 'c':
      created[object] = 1;
      start(object);
      break;
    case 'j':
      if (!created[object]) end_now('m', self);
      created[object] = 0;
      pthread_join(threads[object], NULL);
      break;
    case 'n': pthread_cond_signal(&conditions[object]); break;
    case 'b': pthread_cond_broadcast(&conditions[object]); break;
    case 'a': sem_wait(&units[object]); break;
    case 'A': add_read(self, acquire_before(object, after(operand))); break;
    case 'v': add_read(self, units_of(object)); break;
    case 'q': add_read(self, sem_trywait(&units[object]) == 0); break;
    case 'r': sem_post(&units[object]); break;
    case 'z': nanosleep(&span, NULL); break;
    case 'k': end_now('k', self); break;
    case 'l':
    case 't':
    case 'u':
    case 'w':
    case 'L':
    case 'W': use_mutex(self, step, object, operand, held); break;
    default: access_atomic(self, step, object, operand);
  }
}

static void* run(void* argument) {
  const int self = (int)(long)argument;
  int created[threads_max] = {0}, held[objects] = {0};
  const char* at = texts[self];
  while (at != NULL && *at != '\0' && *at != '|' && *at != 'e') {
    const int object = (unsigned char)at[1] - '0', operand = (unsigned char)at[2] - '0';
    record->threads[self].step = (unsigned char)*at;
    record->threads[self].object = object;
    int next = 1;
    if (*at != 's')
      execute(self, *at, object, operand, created, held);
    else if (record->threads[self].count > 0 && record->threads[self].reads[record->threads[self].count - 1] == 0)
      next += operand;
    record->threads[self].step = 0;
    for (; next > 0 && *at != '\0' && *at != '|'; --next) {
      at += 3;
      if (*at == ' ') ++at;
    }
  }
  if (held[0] || held[1]) end_now('m', self);
  record->threads[self].has_ended = 1;
  return NULL;
}

int main(int count, char** arguments) {
  if (count != 3 || strlen(arguments[1]) < objects) return 2;
  const int file = open(arguments[2], O_RDWR | O_CREAT, 0644);
  const off_t size = file < 0 ? -1 : lseek(file, 0, SEEK_END);
  if (size < 0 || ftruncate(file, size + page) != 0) return 2;
  record = mmap(NULL, page, PROT_READ | PROT_WRITE, MAP_SHARED, file, size);
  if (record == MAP_FAILED) return 2;
  for (int i = 0; i < objects; ++i) sem_init(&units[i], 0, (unsigned)(arguments[1][i] - '0'));
  sem_init(&turn, 0, 0);
  for (int i = 0; i < objects; ++i)
    if (strstr(arguments[1], i == 0 ? "x0" : "x1") == NULL) files[i] = open(arguments[2], O_RDONLY);
  is_variable = strstr(arguments[1], "x1") == NULL && strstr(arguments[1], "f1") == NULL;
  setenv("VALUE", "0", 1);
  int thread = 0;
  for (const char* at = strchr(arguments[1], '|'); at != NULL && thread < threads_max; at = strchr(at, '|'))
    texts[thread++] = ++at;
  atexit(end_normally);
  record->threads[0].is_created = 1;
  run((void*)0);
  pthread_exit(NULL);
}
