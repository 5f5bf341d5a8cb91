#!/usr/bin/python3
"""zebra.py SAMPLES.npy ROWS COLUMNS OUT.png: stripes of reflected light on a height field seen from above, from rows
u,v,x,y,z,xu,yu,zu,xv,yv,zv as 'pia eval MODEL --samples ROWS,COLUMNS --derivative 1 -o SAMPLES.npy' writes them. A stripe that breaks
shows a break of the normal, a kink in it one of the curvature. Heights count a quarter, so that steep ground has stripes at all."""
import struct
import sys
import zlib

import numpy

STRIPES, WIDTH, HEIGHTS = 4, 560, 0.25


def write_png(path, grey):
    rows = b"".join(b"\0" + line.tobytes() for line in grey)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)),
                           (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
            out.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))


def main(path, rows, columns, out):
    table = numpy.load(path).reshape(int(rows) * int(columns), -1)
    points, along_u, along_v = table[:, 2:5], table[:, 5:8] * (1, 1, HEIGHTS), table[:, 8:11] * (1, 1, HEIGHTS)
    normal = numpy.cross(along_u, along_v)
    normal /= numpy.linalg.norm(normal, axis=1, keepdims=True)
    angle = numpy.arcsin(numpy.clip(normal[:, 0] + normal[:, 1], -1.41, 1.41) / 1.4143)
    shade = numpy.where(numpy.sin(2 * STRIPES * angle) > 0, 230.0, 25.0)
    low, high = points.min(0), points.max(0)
    scale = (WIDTH - 1) / (high[0] - low[0])
    x = numpy.rint((points[:, 0] - low[0]) * scale).astype(int)
    y = numpy.rint((high[1] - points[:, 1]) * scale).astype(int)
    shape = (y.max() + 1, WIDTH)
    pixel = y * WIDTH + x
    hits = numpy.bincount(pixel, minlength=shape[0] * WIDTH)
    total = numpy.bincount(pixel, shade, minlength=shape[0] * WIDTH)
    grey = numpy.where(hits > 0, total / numpy.maximum(hits, 1), 255)
    write_png(out, grey.reshape(shape).astype(numpy.uint8))


main(*sys.argv[1:])
