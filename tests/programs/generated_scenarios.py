# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios that name files in every way, drawn at random: write(folder, seed, has) returns the scenario's file.

Names are relative, absolute, with `..` and through symbolic links; files lie in nested folders. `has` names the parts of
the build: "gltf", "tcl".
"""

import base64
import os
import random
import struct

STL = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 1\nvertex 0 1 1\nendloop\nendfacet\nendsolid s\n"
OBJ = "mtllib colours.mtl\nv 0 0 0\nv 1 0 1\nv 0 1 1\nf 1 2 3\n"
PGM = b"P5\n40 40\n255\n" + bytes([0] + [255] * 1599)
LAUNCH = "<launch>{}</launch>\n"
NODE = '<node name="{}" pkg="p" type="t" required="true"/>'


def gltf(uri):
    return ('{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],'
            '"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],'
            '"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [2,3,0]}],'
            f'"bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"uri": "{uri}", "byteLength": 36}}]}}\n')


def inline(buffer):
    return "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()


class Writer:
    def __init__(self, folder, seed, has):
        self.folder, self.has, self.draw, self.number = folder, has, random.Random(seed), 0

    def file(self, ending, contents, beside=None):
        """Writes a file, in a folder of its own or that of `beside`; returns its path."""
        self.number += 1
        folders = [self.folder, self.folder / "a", self.folder / "a/b", self.folder / "c d"]
        folder = beside.parent if beside else self.draw.choice(folders)
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"f{self.number}{ending}"
        path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
        return path

    def name(self, path, at):
        """A name of a file in one whose folder is `at`. What names others itself is not behind a link: names in it would
        be relative to the link."""
        is_leaf = path.suffix in (".stl", ".obj", ".pgm", ".bin", ".txt", ".inc", ".tcl")
        kind = self.draw.choice(["relative", "absolute", "detour"] + ["link"] * is_leaf)
        if kind == "absolute":
            return str(path)
        if kind == "link":
            self.number += 1
            link = at / f"l{self.number}{path.suffix}"
            link.symlink_to(path)
            path = link
        relative = os.path.relpath(path, at)
        return f"../{at.name}/{relative}" if kind == "detour" else relative

    def mesh(self):
        """An STL, an OBJ, whose colours nobody reads, or a glTF with its buffer."""
        kind = self.draw.choice(["stl", "obj"] + ["gltf"] * ("gltf" in self.has))
        if kind != "gltf":
            return self.file(f".{kind}", STL if kind == "stl" else OBJ)
        buffer = self.file(".bin", struct.pack("<9f", 0, 0, 0, 2, 0, 0, 0, 3, 0))
        mesh = self.file(".gltf", "")
        inside = self.draw.random() < 0.3
        uri = inline(buffer.read_bytes()) if inside else os.path.relpath(buffer, mesh.parent)
        mesh.write_text(gltf(uri))
        return mesh

    def map(self):
        kind = self.draw.choice(["segments", "map_server", "moved", "sdf", "stage"])
        if kind == "segments":
            return self.file(".txt", "50 0 51 0\n")
        if kind in ("map_server", "moved"):
            image = self.file(".pgm", PGM)
            path = self.file(".yaml", "", beside=image if kind == "moved" else None)
            name = f"/nowhere/{image.name}" if kind == "moved" else self.name(image, path.parent)
            path.write_text(f"image: '{name}'\nresolution: 0.25\norigin: [-5, -5, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")
            return path
        if kind == "sdf":
            mesh = self.mesh()
            path = self.file(".world", "")
            folder = path.parent / "models" / f"m{self.number}"
            folder.mkdir(parents=True)
            link = "<link name='l'><collision name='c'><geometry>{}</geometry></collision></link>"
            (folder / "model.sdf").write_text(
                f"<sdf version='1.6'><model name='m'><static>true</static>{link.format('<box><size>1 1 1</size></box>')}</model></sdf>")
            named = f"<mesh><uri>{self.name(mesh, path.parent)}</uri></mesh>"
            path.write_text("<sdf version='1.6'><world name='w'><include><uri>model://" + folder.name + "</uri><pose>30 30 0 0 0 0</pose></include>"
                            f"<model name='n'><static>true</static><pose>40 40 0 0 0 0</pose>{link.format(named)}</model></world></sdf>")
            return path
        image = self.file(".pgm", PGM)
        included = self.file(".inc", 'define plan model( size [2 2 1] )\n')
        path = self.file(".world", "")
        path.write_text(f'include "{self.name(included, path.parent)}"\n'
                        f'plan( name "p" pose [60 60 0 0] bitmap "{self.name(image, path.parent)}" )\n')
        return path

    def urdf(self):
        mesh = self.mesh()
        path = self.file(".urdf", "")
        if self.draw.random() < 0.3:
            (path.parent / "pack").mkdir(exist_ok=True)
            mesh = (path.parent / "pack" / mesh.name)
            mesh.write_text(STL) if mesh.suffix == ".stl" else mesh.write_text(OBJ)
            name = f"package://pack/{mesh.name}" if mesh.suffix in (".stl", ".obj") else "nothing.stl"
        else:
            name = self.name(mesh, path.parent)
        path.write_text("<robot name='r'><link name='base'><collision><geometry><cylinder radius='0.2' length='0.5'/></geometry></collision>"
                        f"<collision><geometry><mesh filename='{name}'/></geometry></collision></link></robot>")
        return path

    def launch(self):
        values = self.file(".yaml", "a: 1\n")
        text = self.file(".txt", "some text\n")
        inner = self.file(".launch", LAUNCH.format(NODE.format("inner")))
        path = self.file(".launch", "")
        path.write_text(LAUNCH.format(
            f'<rosparam command="load" file="{values}"/>'
            f'<param name="x" textfile="{text}"/>'
            f'<include file="{inner}"/>{NODE.format("outer")}'))
        return path

    def scenario(self):
        path = self.folder / "scenario.yaml"
        at = path.parent
        chance = lambda: self.draw.random() < 0.5
        quoted = lambda file, base=at: "'" + self.name(file, base) + "'"
        world, robot, types = ["step_ms: 10"], ["name: ada", "start: [0, 0, 0]"], []
        if chance():
            floor = self.file(".yaml", "")
            shapes = [f"{{mesh: {quoted(self.mesh(), floor.parent)}, at_m: [20, 20]}}"] if chance() else []
            floor.write_text(f"format: 1\nshapes: [{', '.join(shapes)}]\n" +
                             (f"map: {quoted(self.map(), floor.parent)}\n" if chance() else ""))
            world.append(f"include: {quoted(floor)}")
        if chance():
            world.append(f"map: {quoted(self.map())}")
        if chance():
            world.append(f"shapes: [{{mesh: {quoted(self.mesh())}, at_m: [-20, 20]}}]")
        body = f"urdf: {quoted(self.urdf())}" if chance() else "shape: {radius_m: 0.2, height_m: 1}"
        if chance():
            included = self.file(".yaml", "")
            if body.startswith("urdf"):
                body = f"urdf: {quoted(self.urdf(), included.parent)}"
            included.write_text(f"format: 1\nrobot_types: {{kind: {{{body}}}}}\n")
            types = [f"robot_types: {{include: {quoted(included)}}}"]
            robot.append("type: kind")
        else:
            robot.append(body)
        if chance():
            robot.append(f"launch: {quoted(self.launch())}")
        elif "tcl" in self.has and chance():
            robot.append(f"executive: {{tcl: {quoted(self.file('.tcl', 'puts hello' + chr(10)))}}}")
        path.write_text("\n".join(["format: 1", "name: drawn", "until_s: 0.1", f"world: {{{', '.join(world)}}}", *types,
                                   f"robots: [{{{', '.join(robot)}}}]"]) + "\n")
        return path


def write(folder, seed, has):
    return Writer(folder.resolve(), seed, has).scenario()
