// SPDX-License-Identifier: BSD-3-Clause
//
// locks CASE [safe]: a lost update, a lost wake-up and crossed locks with GLib's mutexes; correct with a second word.
#include <glib.h>
#include <string.h>

static GMutex one, two;
static GCond changed;
static int balance, is_safe;
static gboolean ready;

static gpointer add(gpointer none) {
  g_mutex_lock(&one);
  const int seen = balance;
  if (!is_safe) {
    g_mutex_unlock(&one);
    g_mutex_lock(&one);
  }
  balance = seen + 1;
  g_mutex_unlock(&one);
  return none;
}

static gpointer give(gpointer none) {
  g_mutex_lock(&one);
  ready = TRUE;
  g_cond_signal(&changed);
  g_mutex_unlock(&one);
  return none;
}

static gpointer await_ready(gpointer none) {
  g_mutex_lock(&one);
  if (is_safe) {
    while (!ready) g_cond_wait(&changed, &one);
  } else if (!ready) {
    g_mutex_unlock(&one);
    g_mutex_lock(&one);
    g_cond_wait(&changed, &one);
  }
  g_mutex_unlock(&one);
  return none;
}

static gpointer take_both(gpointer is_reversed) {
  GMutex* const first = is_reversed && !is_safe ? &two : &one;
  GMutex* const second = first == &one ? &two : &one;
  g_mutex_lock(first);
  g_mutex_lock(second);
  ++balance;
  g_mutex_unlock(second);
  g_mutex_unlock(first);
  return NULL;
}

int main(int count, char** words) {
  is_safe = count > 2;
  const gboolean updates = strcmp(words[1], "update") == 0, wakes = strcmp(words[1], "wake-up") == 0;
  GThread* const other = g_thread_new("other", updates ? add : wakes ? give : take_both, NULL);
  (updates ? add : wakes ? await_ready : take_both)(GINT_TO_POINTER(1));
  g_thread_join(other);
  return wakes || balance == 2 ? 0 : 1;
}
