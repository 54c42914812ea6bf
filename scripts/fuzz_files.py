# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files that geocone reads, whole and damaged, for scripts/fuzz.

Each function takes a random.Random, so that the same seed gives the same file.
"""

import os
import re
import struct

import h5py
import numpy as np

MARKER = "a-command-ran"  # the file that an injected command would make
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])")
NUMBERS = ["nan", "inf", "-inf", "-1", "0", "-0", "1e308", "-1e308", "1e400", "1e-300",
           "2147483647", "2147483648", "4294967296", "18446744073709551616", "65536",
           "0.5", "1,5", "1e", "x", "", "'", "%s%n", "3e9"]


# Meshes: the file of two squares of the tests, in all formats of .msh that are read.

def read_mesh(text):
    """Physical names (dim, tag, name), nodes and elements (type, physical tag, its
    curve or surface, nodes) of an ASCII .msh file of version 2.2."""
    def section(name):
        lines = text.split(f"${name}\n")[1].split(f"$End{name}")[0].splitlines()[1:]
        return [line.split() for line in lines]
    names = [(int(dim), int(tag), name) for dim, tag, name in section("PhysicalNames")]
    nodes = [[float(x) for x in line[1:]] for line in section("Nodes")]
    elements = [(int(kind), int(physical), int(entity), [int(n) for n in nodes])
                for _, kind, _, physical, entity, *nodes in section("Elements")]
    return names, nodes, elements


def mesh_file(text, version, binary):
    """The mesh of a text of version 2.2, written as version 2.2 or 4.1."""
    names, nodes, elements = read_mesh(text)
    out = [f"$MeshFormat\n{version} {int(binary)} 8\n".encode(),
           struct.pack("<i", 1) + b"\n" if binary else b"", b"$EndMeshFormat\n",
           f"$PhysicalNames\n{len(names)}\n".encode(),
           *(f"{dim} {tag} {name}\n".encode() for dim, tag, name in names),
           b"$EndPhysicalNames\n"]

    def put(codes, *values):  # i: int, s: size_t, d: double
        if binary:
            return struct.pack("<" + codes.replace("s", "Q"), *values)
        return (" ".join(map(str, values)) + "\n").encode()
    if version == "2.2":
        out.append(f"$Nodes\n{len(nodes)}\n".encode())
        out += [put("iddd", i, *x) for i, x in enumerate(nodes, 1)]
        out.append(f"\n$EndNodes\n$Elements\n{len(elements)}\n".encode())
        for i, (kind, physical, entity, corners) in enumerate(elements, 1):
            out.append(put("iii", kind, 1, 2) if binary else b"")
            start = (i,) if binary else (i, kind, 2)
            values = (*start, physical, entity, *corners)
            out.append(put("i" * len(values), *values))
        return b"".join([*out, b"\n$EndElements\n"])
    entities = dict.fromkeys((1 if kind == 1 else 2, entity, physical)
                             for kind, physical, entity, _ in elements)
    curves = [e for e in entities if e[0] == 1]
    out.append(b"$Entities\n" + put("ssss", 0, len(curves), len(entities) - len(curves),
                                    0))
    out += [put("iddddddsis", tag, 0., 0., 0., 2., 1., 0., 1, physical, 0)
            for _, tag, physical in sorted(entities)]
    surface = max(entities)[1]
    out += [b"\n$EndEntities\n$Nodes\n", put("ssss", 1, len(nodes), 1, len(nodes)),
            put("iiis", 2, surface, 0, len(nodes)),
            *(put("s", i + 1) for i in range(len(nodes))),
            *(put("ddd", *x) for x in nodes), b"\n$EndNodes\n$Elements\n",
            put("ssss", len(entities), len(elements), 1, len(elements))]
    number = 0
    for dim, tag, _ in entities:
        mine = [e for e in elements if e[2] == tag and (1 if e[0] == 1 else 2) == dim]
        out.append(put("iiis", dim, tag, mine[0][0], len(mine)))
        for _, _, _, corners in mine:
            number += 1
            out.append(put("s" * (1 + len(corners)), number, *corners))
    return b"".join([*out, b"\n$EndElements\n"])


def particles(path):
    """Writes 8 x 6 points in a box of 0.8 m x 0.6 m as .csv or .h5."""
    x, y = (a.ravel() for a in np.meshgrid(0.05 + 0.1 * np.arange(8),
                                           0.05 + 0.1 * np.arange(6)))
    columns = {"x": x, "y": y, "volume": 0. * x + 0.01, "material": 0. * x,
               "vx": 0. * x, "vy": 0. * x, "sxx": 0. * x - 1e3, "syy": 0. * x - 2e3,
               "sxy": 0. * x}
    if path.suffix == ".h5":
        with h5py.File(path, "w") as file:
            for name, values in columns.items():
                file[name] = values
    else:
        lines = [",".join(f"{value:g}" for value in row)
                 for row in zip(*columns.values())]
        path.write_text("\n".join([",".join(columns), *lines]) + "\n")


# Damage: each returns the new bytes and what was done, in words.

def truncate(rng, data):
    n = rng.randrange(len(data) + 1)
    return data[:n], f"cut after {n} of {len(data)} bytes"


def flip(rng, data):
    data, places = bytearray(data), [rng.randrange(len(data) or 1)
                                     for _ in range(rng.choice((1, 3, 30)))]
    for place in places:
        data[place:place + 1] = bytes([rng.randrange(256)])
    return bytes(data), f"random bytes at {places[:3]}"


def overwrite(rng, data):
    what = rng.choice([struct.pack("<d", float("nan")), struct.pack("<d", 1e308),
                       struct.pack("<i", -1), struct.pack("<i", 2**31 - 1),
                       struct.pack("<Q", 2**63), b"\0" * 64, rng.randbytes(100)])
    n = rng.randrange(len(data) + 1)
    return data[:n] + what + data[n + len(what):], f"{what[:8]!r} at {n}"


def junk(rng, data):
    return rng.randbytes(rng.choice((0, 1, 100, 100000))), "random bytes only"


def lines(rng, data):
    parts = data.split(b"\n")
    i, j = rng.randrange(len(parts)), rng.randrange(len(parts))
    what = rng.choice(("deleted", "duplicated", "exchanged", "repeated 100 times"))
    if what == "deleted":
        del parts[i]
    elif what == "duplicated":
        parts.insert(i, parts[i])
    elif what == "exchanged":
        parts[i], parts[j] = parts[j], parts[i]
    else:
        parts[i:i + 1] = [parts[i]] * 100
    return b"\n".join(parts), f"line {i + 1} {what}"


def numbers(rng, data):
    text = data.decode("latin-1")
    found = list(NUMBER.finditer(text))
    if not found:
        return junk(rng, data)
    place = rng.choice(found)
    value = (rng.choice(found)[0] if rng.random() < 0.3 else rng.choice(NUMBERS))
    text = text[:place.start()] + value + text[place.end():]
    line = text[:place.start()].count("\n") + 1
    return text.encode("latin-1"), f"line {line}: {place[0][:20]} -> {value!r}"


def characters(rng, data):
    n = rng.randrange(len(data) + 1)
    what = rng.choice([b"\xef\xbb\xbf", b"\0", b"\r", b"\\\n", b",", b";", b"\n", b"#",
                       b"end\n", b"subsection x\n", b"include scene.prm\n", b"\xff\xfe",
                       b"include /dev/zero\n", b"include .\n", b"x" * 100000, b"(" * 5000,
                       f"'; touch {MARKER}; '".encode(), "漢字".encode(), b"%s%n"])
    n = 0 if what.startswith((b"\xef", b"\xff")) else n
    if rng.random() < 0.1:
        return data.replace(b"\n", b"\r\n"), "line ends of DOS"
    return data[:n] + what + data[n:], f"{what[:20]!r} at {n}"


def script(_, data):
    """What the library that reads meshes could take for its own language."""
    return (f'SystemCall "touch {MARKER}";\nPoint(1) = {{0, 0, 0}};\n'.encode() + data,
            "commands of a geometry script before it")


BINARY = [truncate, flip, overwrite, junk]
TEXT = BINARY[:2] + [lines, lines, numbers, numbers, numbers, characters, junk]


def damage_hdf5(rng, path):
    """Changes one dataset; returns what was done."""
    with h5py.File(path, "r+") as file:
        names = []
        file.visititems(lambda name, part: names.append(name)
                        if isinstance(part, h5py.Dataset) else None)
        name = rng.choice(names)
        values = file[name][...]
        del file[name]
        if rng.random() < 0.1:
            return f"{name} is missing"
        if values.dtype == np.int8:  # a text
            text = values.tobytes()
            what = rng.choice([b"end\nend\n", b"", text.replace(b"soil", b"a/b"),
                               text[:len(text) // 2], numbers(rng, text)[0],
                               lines(rng, text)[0], b"subsection " * 1000])
            file[name] = np.frombuffer(what, np.int8)
            return f"{name} = {what[:30]!r}"
        what = rng.choice(("entry",) * 6 + ("shorter", "longer", "empty", "text",
                                            "two dimensions", "group", "scalar", "cast"))
        if what == "entry" and values.size:
            real = values.dtype.kind == "f"
            value = rng.choice([np.nan, np.inf, 1e308, -1., 0., 1e-300] if real else
                               [-1, 2**31 - 1, -2**31, 0, 1, 1000000])
            place = rng.randrange(values.size)
            values.ravel()[place] = value
            what = f"entry {place} = {value:g}"
            file[name] = values
        elif what == "group":
            file.create_group(name)
        else:
            file[name] = {"shorter": lambda: values.ravel()[:-1],
                          "longer": lambda: np.append(values.ravel(), values.ravel()),
                          "empty": lambda: values.ravel()[:0],
                          "text": lambda: np.array([b"text"] * 4),
                          "two dimensions": lambda: values.reshape(1, -1),
                          "scalar": lambda: 1.,
                          }.get(what, lambda: values.astype(np.float32))()
        return f"{name}: {what}"


def special(rng, path):
    """Puts something else than a file with data into its place."""
    what = rng.choice(("missing", "folder", "/dev/zero", "/dev/null", "pipe", "loop",
                       "dangling", "empty", "unreadable"))
    if what == "unreadable" and os.geteuid() != 0:  # root reads all
        path.chmod(0)
        return what
    path.unlink()
    if what == "folder":
        path.mkdir()
    elif what == "pipe":
        os.mkfifo(path)
    elif what == "empty":
        path.touch()
    elif what not in ("missing", "unreadable"):
        path.symlink_to({"loop": path.name, "dangling": "nothing"}.get(what, what))
    return what


def damage(rng, path):
    """Damages a file in one of the ways that its kind allows; returns it in words."""
    if rng.random() < 0.08:
        return f"{path.name}: {special(rng, path)}"
    if path.suffix == ".h5" and rng.random() < 0.75:
        return f"{path.name}: {damage_hdf5(rng, path)}"
    data = path.read_bytes()
    if path.suffix == ".msh" and rng.random() < 0.05:
        if rng.random() < 0.5:
            path.with_name(path.name + ".opt").write_text(
                f'SystemCall "touch {MARKER}";\n')
            return f"{path.name}: a file of options beside it"
        ways = [script]
    else:
        ways = TEXT if b"\0" not in data else BINARY
    data, what = rng.choice(ways)(rng, data)
    path.write_bytes(data)
    return f"{path.name}: {what}"
