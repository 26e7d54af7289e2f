# SPDX-License-Identifier: BSD-3-Clause
"""The steps of packaging/Dockerfile in roots that stand in for images: docker_test.py [BASE].

Each stage is a copy of a minimal Debian 12, made by debootstrap (or of BASE, such a root as a folder or a tar archive). Needs
root and Debian's archive, and builds the packages: a quarter of an hour of two cores. `./dev test --docker` runs this.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from dockerfile import stages_of

TREE = pathlib.Path(__file__).resolve().parents[2]
BASE = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
ENVIRONMENT = {"PATH": "/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8"}


class Image:
    """A root, with what the instructions of its stage have set."""

    def __init__(self, root):
        self.root = root
        self.folder, self.user, self.settings = "/", "root", {}
        self.entrypoint, self.command = [], []
        if BASE is None:
            subprocess.run(["debootstrap", "--variant=minbase", "bookworm", root], check=True, stdout=subprocess.DEVNULL)
        elif BASE.is_dir():
            subprocess.run(["cp", "-a", BASE, root], check=True)
        else:
            root.mkdir()
            subprocess.run(["tar", "-xf", BASE, "-C", root], check=True)

    def inside(self, words, folder=None, **options):
        """Runs a program in name spaces of its own: nothing stays mounted, and no process is left."""
        folder = folder or self.folder
        setup = f'mount -t proc proc /proc && cd "{folder}" && exec "$@"'
        login = ["setpriv", f"--reuid={self.user}", f"--regid={self.user}", "--init-groups"] if self.user != "root" else []
        return subprocess.run(["unshare", "--mount", "--pid", "--fork", "--kill-child", "chroot", self.root, "sh", "-c", setup, "sh",
                               *login, *words], env={**ENVIRONMENT, **self.settings}, text=True, timeout=3600,
                              capture_output=True, **options)

    def run(self, step, others):
        mounted = []
        for flag in step.flags:
            mount = dict(part.split("=", 1) for part in flag.removeprefix("--mount=").split(","))
            target = self.root / mount["target"].lstrip("/")
            if mount["type"] != "bind" or target.exists():
                raise AssertionError(f"cannot do {flag}")
            shutil.copytree(others[mount["from"]].root / mount["source"].lstrip("/"), target)
            mounted.append(target)
        done = self.inside(["sh", "-c", step.words])
        for target in mounted:
            shutil.rmtree(target)
        if done.returncode != 0:
            raise AssertionError(f"RUN {step.words}\nended with {done.returncode}:\n{(done.stdout + done.stderr)[-6000:]}")

    def copy(self, step):
        """Of the context: what git tracks, as the file beside the Dockerfile leaves out the rest, and its own folder."""
        if step.words != ". ." or step.flags:
            raise AssertionError(f"cannot do COPY {step.words}")
        subprocess.run(["git", "clone", "-q", "--no-hardlinks", TREE, self.root / self.folder.lstrip("/") / "clone"], check=True)
        clone = self.root / self.folder.lstrip("/") / "clone"
        for path in list(clone.iterdir()):
            path.rename(clone.parent / path.name)
        clone.rmdir()

    def do(self, step, others):
        if step.name == "RUN":
            self.run(step, others)
        elif step.name == "COPY":
            self.copy(step)
        elif step.name == "WORKDIR":
            self.folder = step.words
            (self.root / step.words.lstrip("/")).mkdir(parents=True, exist_ok=True)
        elif step.name == "ARG":
            name, value = step.words.split("=", 1)
            self.settings[name] = value.strip('"')
        elif step.name == "USER":
            self.user = step.words
        elif step.name == "ENTRYPOINT":
            self.entrypoint = json.loads(step.words)
        elif step.name == "CMD":
            self.command = json.loads(step.words)
        else:
            raise AssertionError(f"cannot do {step.name}")


class Steps(unittest.TestCase):
    def test_the_image_is_made_and_runs_the_office(self):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="docker-steps-"))
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        images = {}
        for number, stage in enumerate(stages_of((TREE / "packaging/Dockerfile").read_text())):
            image = images[stage.name] = Image(folder / str(number))
            for step in stage.instructions:
                begin = time.monotonic()
                image.do(step, images)
                print(f"{time.monotonic() - begin:6.0f} s  {step.name} {step.words[:90]}", flush=True)
        self.assertEqual(image.user, "waitpoint")
        self.assertIn("run", image.inside([*image.entrypoint, *image.command]).stdout)
        office = image.inside([*image.entrypoint, "run", "office.yaml"])
        digest = re.search(r"wp1:[0-9a-f]{16}", office.stdout)
        self.assertTrue(digest, office.stdout + office.stderr)
        self.assertIn(digest[0], (TREE / "README.md").read_text())
        self.assertEqual(image.inside([*image.entrypoint, "exec", "--", "/bin/sh", "-c", "sleep 100; id -u"]).stdout.count("\n"), 1)
        self.assertIn("uid", image.inside(["id"]).stdout)
        self.assertNotIn("uid=0", image.inside(["id"]).stdout)
        self.assertEqual(list((image.root / "var/lib/apt/lists").iterdir()), [])
        self.assertFalse((image.root / "packages").exists())


if __name__ == "__main__":
    unittest.main()
