// SPDX-License-Identifier: BSD-3-Clause
//
// A libuv loop with work for its thread pool, which notifies the loop of each piece, and a timer.
#include <stdio.h>
#include <uv.h>

enum { pieces = 400 };
static uv_async_t told;
static uv_timer_t timer;
static int left = pieces, ticks, done;

static void on_told(uv_async_t* handle) { (void)handle; }
static void on_tick(uv_timer_t* handle) { (void)handle, ++ticks; }
static void work(uv_work_t* piece) {
  (void)piece;
  uv_sleep(5);
  uv_async_send(&told);
}
static void after(uv_work_t* piece, int status) {
  (void)piece, (void)status, ++done;
  if (--left > 0) return;
  uv_close((uv_handle_t*)&told, NULL);
  uv_close((uv_handle_t*)&timer, NULL);
}

int main(void) {
  static uv_work_t piece[pieces];
  uv_loop_t* loop = uv_default_loop();
  uv_async_init(loop, &told, on_told);
  uv_timer_init(loop, &timer);
  uv_timer_start(&timer, on_tick, 10, 10);
  for (int i = 0; i < pieces; ++i) uv_queue_work(loop, &piece[i], work, after);
  uv_run(loop, UV_RUN_DEFAULT);
  printf("%d pieces, the timer came: %s\n", done, ticks > 0 ? "yes" : "no");
  return 0;
}
