#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Builds Debian's packages of this tree, as it is tracked by git, and its source package: package.sh FOLDER [PROFILE...]
# The packages are in FOLDER; equal trees give equal bytes. What an earlier build left in FOLDER is deleted.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/tools/dev/packages.sh"

folder=${1:?package.sh FOLDER [PROFILE...]}
profiles=()
(($# < 2)) || profiles=("--build-profiles=$(IFS=,; echo "${*:2}")")
git -C "$root" rev-parse HEAD >/dev/null || { say 'packages are built from a clone of the repository'; exit 2; }
version=$(dpkg-parsechangelog -l "$root/debian/changelog" -S Version)
upstream=${version%-*}
# With changes that are not committed; empty if there are none. A fresh machine has no name for the commit's author.
tree=$(git -C "$root" -c user.name=waitpoint -c user.email=waitpoint@localhost stash create)
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
git -C "$root" archive --format=tar --prefix="waitpoint-$upstream/" "${tree:-HEAD}" | tar -x
# As an upstream author's release: without debian/, with the dates of the changelog, in the names' order.
date=$(dpkg-parsechangelog -l "$root/debian/changelog" -S Timestamp)
tar --sort=name --mode=u+rw,go=rX --owner=0 --group=0 --numeric-owner --mtime="@$date" --exclude="waitpoint-$upstream/debian" \
  -c "waitpoint-$upstream" | xz -T1 >"waitpoint_$upstream.orig.tar.xz"
cd "waitpoint-$upstream"
if ! dpkg-checkbuilddeps "${profiles[@]/#--build-profiles=/-P}" 2>/dev/null; then
  say 'installing what the build needs'
  build_dependencies=(env DEBIAN_FRONTEND=noninteractive apt-get "${profiles[@]}" -y -q --no-install-recommends build-dep .)
  as_root "${build_dependencies[@]}" >&2 || { as_root apt-get update >&2 && as_root "${build_dependencies[@]}" >&2; }
fi
dpkg-buildpackage --unsigned-source --unsigned-changes "${profiles[@]}" >&2
cd ..
rm -rf "waitpoint-$upstream"
ls -1 -- *.deb
