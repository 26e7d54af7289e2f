#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds Debian's packages of this tree in surroundings that are unlike those of package.sh: package_again.sh FOLDER [PROFILE...]
# Another folder (of the caller's choice), umask, time zone, locale, name of user and host, number of jobs, and no cache of the compiler.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
umask 077
exec env TZ=Pacific/Kiritimati LC_ALL=POSIX LANGUAGE=de USER=somebody LOGNAME=somebody HOSTNAME=elsewhere CCACHE_DISABLE=1 \
  DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS-} parallel=$(($(nproc) + 1))" "$root/tools/dev/package.sh" "$@"
