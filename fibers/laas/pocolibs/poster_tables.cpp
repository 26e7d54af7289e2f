// SPDX-License-Identifier: BSD-3-Clause
// posterLib's tables, logged line by line.
#include "fibers/laas/pocolibs/posters.hpp"

using waitpoint::laas::Poster;
using waitpoint::laas::Posters;

STATUS posterShow() {
  logMsg("\n");
  logMsg("NAME                              Id/host      Size T(last write)\n");
  logMsg("-------------------------------- -------- --------- -------------\n");
  for (const Poster& poster : Posters::here().all()) {
    if (!poster.open) continue;
    H2TIME date;
    h2timeFromTimespec(&date, &poster.date);
    if (poster.fresh)
      logMsg("%-32s %8d %8zu %02dh:%02dmin%02ds %lu\n", poster.name.c_str(), poster.device, poster.size, date.hour,
             date.minute, date.sec, date.ntick);
    else
      logMsg("%-32s %8d %8zu EMPTY_POSTER!\n", poster.name.c_str(), poster.device, poster.size);
  }
  return OK;
}

STATUS posterStats() {
  logMsg("\n");
  logMsg("NAME                                ReadOps   WriteOps  ReadBytes WriteBytes\n");
  logMsg("-------------------------------- ---------- ---------- ---------- ----------\n");
  for (const Poster& poster : Posters::here().all()) {
    if (!poster.open) continue;
    H2_POSTER_STAT_STR accesses;
    if (posterIoctl(const_cast<Poster*>(&poster), FIO_GETSTATS, &accesses) == OK)
      logMsg("%-32s %10u %10u %10u %10u\n", poster.name.c_str(), accesses.read_ops, accesses.write_ops,
             accesses.read_bytes, accesses.write_bytes);
  }
  return OK;
}
