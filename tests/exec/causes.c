// Programs with one frequent mistake each: causes MISTAKE.
#include <assert.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <stdlib.h>
#include <string.h>

static pthread_mutex_t left = PTHREAD_MUTEX_INITIALIZER, right = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t change = PTHREAD_COND_INITIALIZER;
static int items = 0;
static struct {
  long owner;
  int balance;
} account;
static struct {
  int first, second;
} pair;
static int* config = NULL;

static void* left_then_right(void* unused) {
  pthread_mutex_lock(&left);
  pthread_mutex_lock(&right);
  pthread_mutex_unlock(&right);
  pthread_mutex_unlock(&left);
  return unused;
}

static void* right_then_left(void* unused) {
  pthread_mutex_lock(&right);
  pthread_mutex_lock(&left);
  pthread_mutex_unlock(&left);
  pthread_mutex_unlock(&right);
  return unused;
}

static void* look_then_wait(void* unused) {
  pthread_mutex_lock(&left);
  const int seen = items;
  pthread_mutex_unlock(&left);
  if (seen > 0) return unused;
  pthread_mutex_lock(&left);
  pthread_cond_wait(&change, &left);
  pthread_mutex_unlock(&left);
  return unused;
}

static void* consume(void* unused) {
  pthread_mutex_lock(&left);
  while (items == 0) pthread_cond_wait(&change, &left);
  --items;
  pthread_mutex_unlock(&left);
  return unused;
}

// The second of two items is not notified.
static void* produce(void* unused) {
  pthread_mutex_lock(&left);
  if (++items == 1) pthread_cond_signal(&change);
  pthread_mutex_unlock(&left);
  return unused;
}

static void* deposit(void* unused) {
  account.balance = account.balance + 1;
  return unused;
}

static void* change_both(void* unused) {
  pair.first = pair.first + 1;
  sched_yield();
  pair.second = pair.second + 1;
  return unused;
}

static void* deposit_in_two_sections(void* unused) {
  pthread_mutex_lock(&left);
  const int seen = account.balance;
  pthread_mutex_unlock(&left);
  pthread_mutex_lock(&left);
  account.balance = seen + 1;
  pthread_mutex_unlock(&left);
  return unused;
}

static void* set_up(void* unused) {
  config = malloc(sizeof *config);
  *config = 10;
  return unused;
}

static void* use(void* unused) {
  for (int i = 0; i < 3; ++i) sched_yield();
  assert(*config == 10);
  return unused;
}

static void* lock_once(void* unused) {
  pthread_mutex_lock(&left);
  pthread_mutex_unlock(&left);
  return unused;
}

static sem_t units;
static pthread_once_t once = PTHREAD_ONCE_INIT;
static _Thread_local int own_number;
static int first_number;

static void* give(void* unused) {
  sem_post(&units);
  return unused;
}

static void note_first(void) { first_number = own_number; }

static void* look_once(void* number) {
  own_number = (int)(long)number;
  pthread_once(&once, note_first);
  return NULL;
}

static void run(void* (*one)(void*), void* (*two)(void*)) {
  pthread_t threads[2];
  pthread_create(&threads[0], NULL, one, NULL);
  pthread_create(&threads[1], NULL, two, NULL);
  for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
}

int main(int count, char** words) {
  if (count != 2) return 2;
  const char* const mistake = words[1];
  if (strcmp(mistake, "crossed locks") == 0) run(left_then_right, right_then_left);
  if (strcmp(mistake, "lost wake-up") == 0) run(look_then_wait, produce);
  if (strcmp(mistake, "missed notification") == 0) {
    pthread_t threads[4];
    for (int i = 0; i < 4; ++i) pthread_create(&threads[i], NULL, i < 2 ? consume : produce, NULL);
    for (int i = 0; i < 4; ++i) pthread_join(threads[i], NULL);
  }
  if (strcmp(mistake, "lost update") == 0) run(deposit, deposit);
  if (strcmp(mistake, "two sections") == 0) run(deposit_in_two_sections, deposit_in_two_sections);
  if (strcmp(mistake, "lost update") == 0 || strcmp(mistake, "two sections") == 0) assert(account.balance == 2);
  if (strcmp(mistake, "neighbours") == 0) {
    run(change_both, change_both);
    assert(pair.first == 2 && pair.second == 2);
  }
  if (strcmp(mistake, "initialisation") == 0) run(set_up, use);
  if (strcmp(mistake, "destruction") == 0) {
    pthread_t thread;
    pthread_create(&thread, NULL, lock_once, NULL);
    sched_yield();
    pthread_mutex_destroy(&left);
    pthread_join(thread, NULL);
  }
  if (strcmp(mistake, "unjoined") == 0) {
    pthread_t thread;
    int value;
    pthread_create(&thread, NULL, give, NULL);
    sem_getvalue(&units, &value);
    assert(value == 0);
  }
  if (strcmp(mistake, "once") == 0) {
    pthread_t threads[2];
    for (long i = 0; i < 2; ++i) pthread_create(&threads[i], NULL, look_once, (void*)(i + 1));
    for (int i = 0; i < 2; ++i) pthread_join(threads[i], NULL);
    assert(first_number == 1);
  }
  if (strcmp(mistake, "release") == 0) {
    pthread_mutex_lock(&left);
    pthread_mutex_unlock(&left);
    pthread_mutex_unlock(&left);
  }
  return 0;
}
