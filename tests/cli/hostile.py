"""hostile.py PIA [-v]: files whose headers promise what the file does not hold are refused in one line, within a second of processor time
and 100 MB of memory, programs that pia starts included."""
import json
import os
import struct
import sys
import tempfile

SECONDS, BYTES = 1.0, 100e6
HUGE = 10**18
MOST = HUGE - 1  # the largest count that PLY may name here


def ply(kind, *lines):
    return "\n".join(["ply", f"format {kind} 1.0", *lines, "end_header", ""]).encode()


def las(point_format, count, size=34):
    header = bytearray(375)
    header[0:4] = b"LASF"
    header[24:26] = bytes([1, 4])
    struct.pack_into("<HII", header, 94, 375, 375, 0)
    struct.pack_into("<BHI", header, 104, point_format, size, min(count, 2**32 - 1))
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.01, 0, 0, 0)
    struct.pack_into("<Q", header, 247, count)
    return bytes(header) + bytes(3 * size)


def npy(shape, kind="<f8"):
    text = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text.encode() + bytes(64)


def curve(**changes):
    data = {"type": "spline", "rational": False, "dimension": 2, "degree": 1, "knotvector": [0, 0, 1, 1],
            "control_points": {"points": [[0, 0], [1, 1]]}}
    data.update(changes)
    kind = "surface" if "size_u" in changes else "curve"
    return json.dumps({"shape": {"type": kind, "count": changes.pop("count", 1), "data": [data]}}).encode()


def surface(u, v):
    return curve(size_u=u, size_v=v, degree_u=1, degree_v=1, knotvector_u=[0, 0, 1, 1], knotvector_v=[0, 0, 1, 1])


def step(entities):
    return f"ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n" \
           f"ENDSEC;\nDATA;\n{entities}\nENDSEC;\nEND-ISO-10303-21;\n".encode()


FLOATS = ["property float x", "property float y", "property float z"]
CASES = {
    "vertices.ply": ply("binary_little_endian", f"element vertex {MOST}", *FLOATS) + bytes(36),
    "text.ply": ply("ascii", f"element vertex {MOST}", *FLOATS) + b"0 0 0\n1 1 1\n",
    "digits.ply": ply("ascii", f"element vertex {HUGE}", *FLOATS),
    "overflow.ply": ply("binary_little_endian", f"element vertex {2**64 + 1}", *FLOATS) + bytes(36),
    "faces_first.ply": ply("binary_big_endian", f"element face {MOST}", "property list uint int vertex_indices", "element vertex 1", *FLOATS)
    + b"\xff" * 64,
    "empty_first.ply": ply("ascii", f"element nothing {MOST}", "element vertex 1", *FLOATS) + b"\n" * 64,
    "list_in_vertex.ply": ply("binary_little_endian", "element vertex 3", "property list uint double x", *FLOATS[1:]) + b"\xff" * 64,
    "list_of_lists.ply": ply("ascii", "element vertex 2", "property list list uchar int int x", *FLOATS[1:]) + b"1 1 1 1\n",
    "many_properties.ply": ply("ascii", "element vertex 2", *(f"property float p{i}" for i in range(50000))) + b"0 0\n",
    "many_elements.ply": ply("ascii", *(f"element e{i} {MOST}" for i in range(50000)), "element vertex 1", *FLOATS) + b"0 0 0\n",
    "cut.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 9",
    "points.las": las(1, HUGE),
    "legacy.las": las(0, 2**32 - 1, 20),
    "record.las": las(1, HUGE, 65535),
    "no_record.las": las(1, 3, 0),
    "cut.las": las(1, HUGE)[:120],
    "shape.npy": npy(f"({HUGE}, 3)"),
    "product.npy": npy(f"({2**32}, {2**32})"),
    "three.npy": npy(f"({2**31}, {2**31}, 3)"),
    "nothing.npy": npy(f"({HUGE}, 0)"),
    "header.npy": b"\x93NUMPY\2\0" + b"\xff\xff\xff\xff" + b"{'descr'",
    "grey.pgm": f"P5\n{10**9} {10**9}\n255\n".encode() + bytes(64),
    "text.pgm": f"P2\n{HUGE} {HUGE}\n255\n0 0 0\n".encode(),
    "grid.asc": f"ncols {HUGE}\nnrows {HUGE}\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n1 2 3\n".encode(),
    "one_row.asc": f"ncols {HUGE}\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n".encode(),
    "number.obj": b"v " + b"9" * 1000000 + b" 0 0\nv 0 0\n",
    "one_line.obj": b"v" + b" 0" * 1000000 + b"\n",
    "one_line.csv": b"1," * 2000000 + b"\n",
    "commas.csv": b"," * 4000000,
    "number.csv": b"0 0\n1 " + b"1" * 4000000 + b"e\n",
    "knots.g2": f"100 1 0 0\n3 0\n{HUGE} 4\n{'0 ' * 40}\n".encode(),
    "net.g2": f"200 1 0 0\n3 0\n{10**15} 2\n0 0 1 1\n".encode(),
    "product.g2": f"200 1 0 0\n16 1\n4 2\n0 0 1 2 3 3\n{10**15} 2\n{'0 ' * 40}\n".encode(),
    "size.json": surface(HUGE, HUGE),
    "one_size.json": surface(2, HUGE),
    "degree.json": curve(degree=HUGE),
    "count.json": curve(degree=1, knotvector=[], count=HUGE),
    "deep.json": b"[" * 1000000,
    "deep_data.json": b'{"shape":{"type":"curve","data":' + b'[{"data":' * 100000,
    "string.json": b'{"shape": "' + b"a" * 4000000,
    "trims.json": b'{"shape":{"type":"surface","data":[{"trims":' + b'{"data":[' * 1000 + b"]}" * 1000 + b"}]}}",
    "spline.step": step(f"#1=B_SPLINE_CURVE_WITH_KNOTS('',{HUGE},(#2),.UNSPECIFIED.,.F.,.F.,({HUGE}),(0.),.UNSPECIFIED.);"),
    "ring.step": step("".join(f"#{i}=GEOMETRIC_SET('',(#{i % 1000 + 1}));\n" for i in range(1, 1001))),
    "lists.step": step("#1=GEOMETRIC_SET(''," + "(" * 100000 + ")" * 100000 + ");"),
    "cut.step": step("#1=CARTESIAN_POINT('',(0.,")[:220],
    "cut.igs": b"S".rjust(73) + b"      1\n" + b"1H,,1H;,".ljust(72) + b"G      1\n",
    "scan.laz": b"LASF" + b"\xff" * 400,
    "scan.e57": b"ASTM-E57" + b"\xff" * 400,
}
HARMLESS = {"many_elements.ply", "one_line.obj"}  # odd, but they hold what they say


def measured(pia, name):
    """Exit status, what was told, processor seconds and peak bytes of `pia info NAME`."""
    with open("told", "wb") as told, open("printed", "wb") as printed:
        child = os.posix_spawn(pia, [pia, "info", name], os.environ, file_actions=[
            (os.POSIX_SPAWN_DUP2, printed.fileno(), 1), (os.POSIX_SPAWN_DUP2, told.fileno(), 2)])
        _, status, usage = os.wait4(child, 0)
    with open("told", encoding="utf-8", errors="replace") as told:
        return os.waitstatus_to_exitcode(status), told.read(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def complaint(name, status, told, seconds, peak):
    if name in HARMLESS:
        answered = status == 0 and told == ""
    else:
        answered = status in (2, 3) and told.startswith(f"pia: {name}") and told.count("\n") == 1
    if not answered:
        return f"status {status} and {told[:300]!r}"
    if seconds >= SECONDS or peak >= BYTES:
        return f"took {seconds:.2f} s and {peak / 1e6:.0f} MB to say {told[:100]!r}"
    return None


def main():
    pia = os.path.abspath(sys.argv[1])
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, content in CASES.items():
            with open(name, "wb") as file:
                file.write(content)
            answer = measured(pia, name)
            if "-v" in sys.argv:
                print(f"{name}: {answer[2]:.2f} s, {answer[3] / 1e6:.0f} MB, {answer[1].strip()}")
            wrong = complaint(name, *answer)
            if wrong:
                failed = True
                print(f"{name}: {wrong}")
        os.chdir("/")
    sys.exit(failed)


main()
