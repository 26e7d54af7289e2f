# SPDX-License-Identifier: BSD-3-Clause
"""Copies the tree, with subprojects that need no network: wraps.py FOLDER.

The wraps name upstream's archives, of the releases that Debian 13 has. If only Debian's packages are available, its source
packages contain releases of the same libraries: some archives bit by bit the same, others repacked without files that Debian
may not ship, or, on another Debian, of another version, for which the definitions in packagefiles/ serve too. This script
downloads them with the system's apt, copies the tree to FOLDER/tree and fills the wraps' package cache there; in the copy,
wraps of other archives have new hashes, and their definitions the version of the archive. Another call updates the copy with
changes of the tree.
"""

import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Debian's source packages of the same libraries, by wrap; Boost's has the version in its name.
SOURCE_PACKAGES = {
    "boost": "boost",
    "ccd": "libccd",
    "cli11": "cli11",
    "eigen3": "eigen3",
    "fcl": "fcl",
    "fmt": "fmtlib",
    "gtest": "googletest",
    "libpng": "libpng1.6",
    "nlohmann_json": "nlohmann-json3",
    "tinyxml2": "tinyxml2",
    "yaml-cpp": "yaml-cpp",
    "zlib": "zlib",
}


def find_archive(folder, package):
    """The upstream archive of a source package in `folder`, or None. Boost's package has its version in the name."""
    name = re.compile(re.escape(package) + r"(\d+\.\d+)?_.*\.orig\.tar\.(gz|bz2|xz)$")
    return next((path for path in folder.iterdir() if name.match(path.name)), None)


def upstream_version(archive):
    """The version in a source archive's name, without what Debian adds to it: 1.3.1 of 1.3.dfsg+really1.3.1."""
    version = archive.name.split("_")[1].split(".orig.")[0].split("really")[-1]
    return re.match(r"[\d.]*\d", version).group()


def with_boosts_version(packages):
    """The source packages, with the version of Boost that Debian's default package depends on."""
    depended = subprocess.run(["apt-cache", "depends", "libboost-context-dev"], check=True, capture_output=True, text=True)
    boost = "boost" + re.search(r"libboost-context([\d.]+)-dev", depended.stdout).group(1)
    return [boost if package == "boost" else package for package in packages]


def apt(state, *arguments):
    """apt-get with separate package lists, which hold the source packages of the configured binary ones."""
    command = ["apt-get", "-q", "-o", f"Dir::Etc::sourcelist={state}/sources.list", "-o", "Dir::Etc::sourceparts=-",
               "-o", f"Dir::State::lists={state}/lists", "-o", "Acquire::Retries=3", "-o", "APT::Sandbox::User=root"]
    subprocess.run([*command, *arguments], check=True, stdout=sys.stderr, cwd=state)


def download(packages, folder):
    """Puts the archives of Debian's source packages into `folder`."""
    (folder / "lists/partial").mkdir(parents=True, exist_ok=True)
    targets = subprocess.run(
        ["apt-get", "indextargets", "--format", "deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)", "Created-By: Packages",
         "Origin: Debian"], check=True, capture_output=True, text=True).stdout
    if not targets:
        raise SystemExit("dev: apt has no lists of Debian's packages yet: run apt-get update")
    # A release's own archives are always available; those of its security updates are missing on some mirrors. Both
    # contain the same upstream source.
    suites = {line for line in targets.splitlines(keepends=True) if "-" not in line.split()[2]}
    (folder / "sources.list").write_text("".join(sorted(suites)))
    apt(folder, "update")
    apt(folder, "source", "--download-only", *with_boosts_version(packages))


def files_of_tree(folder):
    """The files of a tree, relative to it, without built and unpacked ones, and without its wraps."""
    for place, folders, files in os.walk(folder):
        place = pathlib.Path(place).relative_to(folder)
        if place == pathlib.Path("."):
            folders[:] = [name for name in folders if not name.startswith((".", "build"))]
        elif place == pathlib.Path("subprojects"):
            folders[:], files = ["packagefiles"], []
        folders[:] = [name for name in folders if name != "__pycache__"]
        yield from (place / name for name in files)


def write_if_new(path, content):
    """Keeps the time of unchanged files, for Ninja."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def copy_tree(source, target):
    """Makes `target` equal to `source`, except for the wraps."""
    wanted = set(files_of_tree(source))
    for path in wanted:
        write_if_new(target / path, (source / path).read_bytes())
        shutil.copymode(source / path, target / path)
    for path in set(files_of_tree(target)) - wanted:
        (target / path).unlink()


def fit(wrap_text, archive):
    """The text of a wrap that uses `archive`: unchanged if it already names that."""
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    if f"source_hash = {digest}\n" in wrap_text:
        return wrap_text
    with tarfile.open(archive) as contents:
        directory = contents.next().name.split("/")[0]
    for key, value in {"directory": directory, "source_filename": archive.name, "source_hash": digest}.items():
        wrap_text = re.sub(rf"^{key} = .*$", f"{key} = {value}", wrap_text, flags=re.MULTILINE)
    return wrap_text


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    sources, tree = folder / "sources", folder / "tree"
    sources.mkdir(parents=True, exist_ok=True)
    missing = [package for package in SOURCE_PACKAGES.values() if not find_archive(sources, package)]
    if missing:
        download(missing, sources)
    copy_tree(ROOT, tree)
    cache = tree / "subprojects/packagecache"
    cache.mkdir(parents=True, exist_ok=True)
    same = 0
    for wrap, package in SOURCE_PACKAGES.items():
        archive = find_archive(sources, package)
        text = (ROOT / f"subprojects/{wrap}.wrap").read_text()
        fitted = fit(text, archive)
        same += fitted == text
        write_if_new(tree / f"subprojects/{wrap}.wrap", fitted.encode())
        definition = tree / f"subprojects/packagefiles/{wrap}/meson.build"
        if definition.exists():
            own = (ROOT / definition.relative_to(tree)).read_text()
            version = upstream_version(archive)
            write_if_new(definition, re.sub(r"(?<!_)version: '[\d.]+'", f"version: '{version}'", own, count=1).encode())
        cached = cache / re.search(r"^source_filename = (.*)$", fitted, re.MULTILINE).group(1)
        if not cached.exists():
            shutil.copyfile(archive, cached)
    print(f"dev: {len(SOURCE_PACKAGES)} archives from Debian, {same} of them identical to upstream's", file=sys.stderr)


if __name__ == "__main__":
    main()
