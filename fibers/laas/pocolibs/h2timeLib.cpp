// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>

#include "fibers/laas/include/h2timeLib.h"
#include "fibers/laas/ticks.hpp"
#include "fibers/sync/run_context.hpp"

namespace laas = waitpoint::laas;
using std::chrono::days;
using std::chrono::floor;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

namespace {

using Date = std::chrono::sys_time<nanoseconds>;

Date start_date() { return waitpoint::sync::RunContext::of(*waitpoint::sync::running_task().scheduler).start_date(); }

Date date_of(const H2TIMESPEC& ts) { return Date(seconds(ts.tv_sec) + nanoseconds(ts.tv_nsec)); }

Date now() {
  const waitpoint::Time local = waitpoint::kernel::local_time(waitpoint::sync::running_task());
  return start_date() + nanoseconds((local - waitpoint::Time()).ns());
}

}  // namespace

void h2timeInit() {}

STATUS h2GetTimeSpec(H2TIMESPEC* pTs) {
  const Date date = now();
  const auto second = floor<seconds>(date);
  pTs->tv_sec = second.time_since_epoch().count();
  pTs->tv_nsec = (date - second).count();
  return OK;
}

STATUS h2timeGet(H2TIME* pTimeStr) {
  H2TIMESPEC ts;
  h2GetTimeSpec(&ts);
  h2timeFromTimespec(pTimeStr, &ts);
  return OK;
}

void h2timeFromTimespec(H2TIME* pTimeStr, const H2TIMESPEC* ts) {
  const Date date = date_of(*ts);
  const auto day = floor<days>(date);
  const std::chrono::year_month_day calendar{day};
  const std::chrono::hh_mm_ss time_of_day{floor<milliseconds>(date - day)};
  const nanoseconds since = date - floor<days>(start_date());
  const auto rate = static_cast<unsigned long>(laas::Ticks::here().rate());
  const auto second = static_cast<unsigned long>(floor<seconds>(since).count());
  const auto rest_ns = static_cast<unsigned long>((since - floor<seconds>(since)).count());
  pTimeStr->ntick = second * rate + rest_ns * rate / 1'000'000'000;
  pTimeStr->msec = static_cast<unsigned short>(time_of_day.subseconds().count());
  pTimeStr->sec = static_cast<unsigned short>(time_of_day.seconds().count());
  pTimeStr->minute = static_cast<unsigned short>(time_of_day.minutes().count());
  pTimeStr->hour = static_cast<unsigned short>(time_of_day.hours().count());
  pTimeStr->day = static_cast<unsigned short>(std::chrono::weekday{day}.iso_encoding());
  pTimeStr->date = static_cast<unsigned short>(static_cast<unsigned>(calendar.day()));
  pTimeStr->month = static_cast<unsigned short>(static_cast<unsigned>(calendar.month()));
  pTimeStr->year = static_cast<unsigned short>(static_cast<int>(calendar.year()) - 1900);
}

void timespecFromH2time(H2TIMESPEC* ts, const H2TIME* pTimeStr) {
  const std::chrono::sys_days day =
      std::chrono::year(pTimeStr->year + 1900) / std::chrono::month(pTimeStr->month) / std::chrono::day(pTimeStr->date);
  const seconds time_of_day =
      std::chrono::hours(pTimeStr->hour) + std::chrono::minutes(pTimeStr->minute) + seconds(pTimeStr->sec);
  ts->tv_sec = (day.time_since_epoch() + time_of_day).count();
  ts->tv_nsec = pTimeStr->msec * 1'000'000L;
}

STATUS h2timeInterval(H2TIME* pOldTime, unsigned long* pNmsec) {
  H2TIME present;
  h2timeGet(&present);
  const auto rate = static_cast<unsigned long>(laas::Ticks::here().rate());
  *pNmsec = 1000 * (present.ntick - pOldTime->ntick) / std::max(rate, 1ul);
  return OK;
}

STATUS h2timespecInterval(const H2TIMESPEC* pOldTime, unsigned long* pNmsec) {
  *pNmsec = static_cast<unsigned long>(floor<milliseconds>(now() - date_of(*pOldTime)).count());
  return OK;
}

STATUS h2timeSet(H2TIME*) { return ERROR; }

STATUS h2timeAdj(H2TIME*) { return ERROR; }

void h2timeShow() {
  H2TIME date;
  h2timeGet(&date);
  logMsg("%04d-%02d-%02d %02d:%02d:%02d.%03d\n", date.year + 1900, date.month, date.date, date.hour, date.minute,
         date.sec, date.msec);
}
