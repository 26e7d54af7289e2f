# SPDX-License-Identifier: BSD-3-Clause
"""The part of Conan 2 that packaging/conan/conanfile.py uses, which is not in Debian: the recipe's steps are done by Meson, with
the libraries of this machine in the place of Conan's packages.
"""

import dataclasses
import fnmatch
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import types


class ConanInvalidConfiguration(Exception):
    pass


class Values(types.SimpleNamespace):
    """Settings and options."""

    def update(self, values):
        vars(self).update(values)


@dataclasses.dataclass
class Information:
    """cpp_info, and its components."""

    libs: list = dataclasses.field(default_factory=list)
    requires: list = dataclasses.field(default_factory=list)
    cxxflags: list = dataclasses.field(default_factory=list)
    properties: dict = dataclasses.field(default_factory=dict)

    def set_property(self, name, value):
        self.properties[name] = value


class Components(dict):
    def __missing__(self, name):
        return self.setdefault(name, Information())


class ConanFile:
    """A recipe with its folders below `folder`."""

    def __init__(self, recipe_folder, folder, options):
        self.recipe_folder = str(recipe_folder)
        self.settings = Values(os="Linux", arch="x86_64", compiler="gcc", build_type="Release")
        self.options = Values(**{**self.default_options, **options})
        self.cpp_info = types.SimpleNamespace(components=Components())
        self.required, self.tools, self.cppstd_min = [], [], None
        self.dependencies = {"boost": types.SimpleNamespace(package_folder="/usr")}
        for name in ("export_sources", "source", "build", "generators", "package"):
            setattr(self, f"{name}_folder", str(folder / ("source" if name == "export_sources" else name)))
            (folder / name).mkdir(exist_ok=True)

    def requires(self, reference):
        self.required.append(reference)

    def tool_requires(self, reference):
        self.tools.append(reference)


class PkgConfigDeps:
    def __init__(self, recipe):
        pass

    def generate(self):
        """This machine's libraries have files of their own."""


class MesonToolchain:
    def __init__(self, recipe):
        self.recipe, self.properties, self.project_options = recipe, {}, {"wrap_mode": "nofallback"}

    def generate(self):
        def text(values):
            return "".join(f"{name} = {str(value).lower() if isinstance(value, bool) else repr(value)}\n"
                           for name, value in values.items())
        kind = "shared" if self.recipe.options.shared else "static"
        built_in = {"buildtype": "release", "b_ndebug": "true", "cpp_std": "c++20", "default_library": kind, "libdir": "lib"}
        (pathlib.Path(self.recipe.generators_folder) / "conan_meson_native.ini").write_text(
            f"[properties]\n{text(self.properties)}[project options]\n{text(self.project_options)}[built-in options]\n{text(built_in)}")


class Meson:
    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self):
        meson("setup", f"--prefix={self.recipe.package_folder}", f"--native-file={self.recipe.generators_folder}/conan_meson_native.ini",
              self.recipe.build_folder, self.recipe.source_folder)

    def build(self):
        meson("compile", "-C", self.recipe.build_folder)

    def install(self):
        meson("install", "-C", self.recipe.build_folder)


def meson(*words):
    done = subprocess.run(["meson", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"meson {' '.join(words)}\nended with {done.returncode}:\n{(done.stdout + done.stderr)[-6000:]}")


def copy(recipe, pattern, src, dst, excludes=""):
    for path in sorted(pathlib.Path(src).rglob("*")):
        name = str(path.relative_to(src))
        if path.is_file() and fnmatch.fnmatch(name, pattern) and not fnmatch.fnmatch(name, excludes):
            (pathlib.Path(dst) / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, pathlib.Path(dst) / name)


def rmdir(recipe, path):
    shutil.rmtree(path, ignore_errors=True)


def check_min_cppstd(recipe, standard):
    recipe.cppstd_min = standard


MODULES = {
    "conan": {"ConanFile": ConanFile},
    "conan.errors": {"ConanInvalidConfiguration": ConanInvalidConfiguration},
    "conan.tools": {},
    "conan.tools.build": {"check_min_cppstd": check_min_cppstd},
    "conan.tools.files": {"copy": copy, "rmdir": rmdir},
    "conan.tools.gnu": {"PkgConfigDeps": PkgConfigDeps},
    "conan.tools.layout": {"basic_layout": lambda recipe: None},
    "conan.tools.meson": {"Meson": Meson, "MesonToolchain": MesonToolchain},
}


def recipe_of(file):
    """The class of the recipe in a conanfile.py."""
    for name, contents in MODULES.items():
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(contents)
    description = importlib.util.spec_from_file_location("conanfile", file)
    module = importlib.util.module_from_spec(description)
    description.loader.exec_module(module)
    return next(each for each in vars(module).values()
                if isinstance(each, type) and issubclass(each, ConanFile) and each is not ConanFile)
