#!/usr/bin/python3
"""Writes tests/golden/epia_*.json: [2011] in a few lines of NumPy, dense matrices and all, as far from the library's code as can be."""
import json
import math
import pathlib

import numpy
from scipy.interpolate import BSpline, insert

root = pathlib.Path(__file__).resolve().parent.parent
P, SHARE, SMOOTH = 3, 0.03, 3


def chord(points):
    t = numpy.r_[0, numpy.cumsum(numpy.linalg.norm(numpy.diff(points, axis=0), axis=1))]
    return t / t[-1]


def height(p, a, b):
    side, base = p - a, b - a
    along = side @ base / (base @ base)
    return math.sqrt(max(side @ side - along * along * (base @ base), 0)) / math.sqrt(base @ base)


def smoothed(points):
    out = points.copy()
    last = len(points) - 1
    for j in range(1, last):
        h = 1
        while h < min(SMOOTH, j, last - j):
            near, far = (numpy.linalg.norm(points[j + k] - points[j - k]) for k in (h, h + 1))
            if far <= near or height(points[j], points[j - h - 1], points[j + h + 1]) < height(points[j], points[j - h], points[j + h]):
                break
            h += 1
        w = numpy.exp(-numpy.arange(-h, h + 1) ** 2 / (2 * (h / 2) ** 2))
        out[j] = w / w.sum() @ points[j - h:j + h + 1]
    return out


def curvature(points):
    s = smoothed(points)
    first, second = (s[2:] - s[:-2]) / 2, s[2:] - 2 * s[1:-1] + s[:-2]
    square = (first * first).sum(1)
    across = numpy.sqrt(numpy.maximum(square * (second * second).sum(1) - (first * second).sum(1) ** 2, 0))
    k = across / square ** 1.5
    return numpy.r_[k[0], k, k[-1]]


def dominant(k, least):
    chosen = [j for j in range(1, len(k) - 1) if k[j - 1] < k[j] > k[j + 1] and k[j] > SHARE * k.max()]
    assert len(chosen) + 2 >= least
    return [0] + chosen + [len(k) - 1]


def fence(t, k, chosen):
    first = [0]
    for s, e in zip(chosen, chosen[1:]):
        if e == s + 1:
            first.append(e)
            continue
        part = k[s:e + 1]
        term = numpy.exp((part - part.min()) / (part.max() - part.min())) * (t[s:e + 1] - t[s]) / (t[e] - t[s])
        difference = [abs(term[:w - s].sum() - term[w - s:e - s].sum()) for w in range(s + 1, e)]
        first.append(s + 1 + int(numpy.argmin(difference)))
    return first + [len(t)]


def groups(first, chosen, own):
    g = [list(range(first[i], first[i + 1])) for i in range(len(chosen))]
    for i, j in enumerate(chosen):
        if j not in own:
            continue
        if i > 0 and chosen[i - 1] not in own:
            g[i - 1] += [r for r in g[i] if r < j]
        if i + 1 < len(chosen) and chosen[i + 1] not in own:
            g[i + 1] = [r for r in g[i] if r > j] + g[i + 1]
        g[i] = [j]
    return g


class Line:
    """One direction: parameters, curvature, the chosen lines, and the matrices that follow from them."""

    def __init__(self, t, k, own):
        self.t, self.k, self.own = t, k, {0, len(t) - 1} | set(own)
        self.chosen = sorted(set(dominant(k, P + 1)) | self.own)
        self.update()

    def update(self):
        s = self.t[self.chosen]
        inside = [s[i:i + P].mean() for i in range(1, len(s) - P)]
        self.knots = numpy.r_[[s[0]] * (P + 1), inside, [s[-1]] * (P + 1)]
        self.basis = BSpline.design_matrix(self.t, self.knots, P).toarray()
        self.first = fence(self.t, self.k, self.chosen)
        self.groups = groups(self.first, self.chosen, self.own)
        self.mean = numpy.zeros((len(s), len(self.t)))
        for i, g in enumerate(self.groups):
            self.mean[i, g] = 1 / len(g)

    def add(self, lines):
        self.chosen = sorted(set(self.chosen) | set(lines))
        self.update()

    def markers(self, group):
        return [m for m in self.first[group:group + 2] if 0 < m < len(self.t) and m not in self.chosen]


def values(u, v, points):
    return numpy.einsum("ri,sj,ijd->rsd", u.basis, v.basis, points)


def carried(line, points, t):
    """Control points with t inserted in the old knots, along axis 0."""
    flat = points.reshape(len(points), -1)
    columns = []
    for column in flat.T:
        knots, c, _ = insert(t, (line.knots, numpy.r_[column, [0] * (P + 1)], P))
        columns.append(c[:len(points) + 1])
    return numpy.array(columns).T.reshape((len(points) + 1,) + points.shape[1:])


def validate(data, u, v, eta, rounds):
    for _ in range(rounds):
        r = data - values(u, v, data[numpy.ix_(u.chosen, v.chosen)])
        more_u, more_v = set(), set()
        for g, a in enumerate(u.groups):
            for h, b in enumerate(v.groups):
                block = r[numpy.ix_(a, b)].reshape(-1, data.shape[2])
                length = numpy.linalg.norm(block, axis=1).sum()
                if len(block) > 1 and length > 0 and numpy.linalg.norm(block.sum(0)) / length <= eta:
                    more_u |= set(u.markers(g))
                    more_v |= set(v.markers(h))
        if not more_u and not more_v:
            return
        u.add(more_u)
        if len(v.t) > 1:
            v.add(more_v)


class Point:
    """The second direction of a curve."""
    t, chosen, basis, mean, groups, first = [0.0], [0], numpy.eye(1), numpy.eye(1), [[0]], [0, 1]

    def markers(self, group):
        return []


def fit(data, u, v, eta, rounds, tolerance, iterations):
    validate(data, u, v, eta, rounds)
    points, trace, last = data[numpy.ix_(u.chosen, v.chosen)], [], math.inf
    for k in range(iterations + 1):
        r = data - values(u, v, points)
        e = numpy.linalg.norm(r, axis=2)
        trace.append((k, points.shape[0] * points.shape[1], e.max(), math.sqrt((e * e).mean())))
        if e.max() <= tolerance:
            break
        step = numpy.einsum("gr,hs,rsd->ghd", u.mean, v.mean, r)
        points = points + step
        moved = numpy.linalg.norm(step, axis=2).max()
        if moved < tolerance / 2 or e.max() > last:
            free = numpy.ones(e.shape, bool)
            free[numpy.ix_(u.chosen, v.chosen)] = False
            i, j = numpy.unravel_index(numpy.argmax(numpy.where(free, e, -1)), e.shape)
            if i not in u.chosen:
                points = carried(u, points, u.t[i])
                u.add([i])
            if len(v.t) > 1 and j not in v.chosen:
                points = carried(v, points.swapaxes(0, 1), v.t[j]).swapaxes(0, 1)
                v.add([j])
        last = e.max()
    return trace


def write(name, data, trace, tolerance, options):
    rows = [{"iteration": k, "control_count": n, "max_error": float(e), "rms_error": float(s), "tolerance": 1e-9 * float(trace[0][2])}
            for k, n, e, s in trace]
    case = {"source": "scripts/golden_epia.py: [2011] with dense matrices of SciPy's B-splines",
            "kind": "curve" if data.shape[1] == 1 else "grid", "count": list(data.shape[:2]), "dim": data.shape[2],
            "points": [float(x) for x in data.ravel()], "options": {"method": "epia", "tolerance": tolerance, **options},
            "expect": {"trace": rows}}
    (root / f"tests/golden/epia_{name}.json").write_text(json.dumps(case) + "\n")


def curve(name, points, eta, tolerance, iterations, own=()):
    u = Line(chord(points), curvature(points), own)
    trace = fit(points[:, None, :], u, Point(), eta, 100, tolerance, iterations)
    options = {"iterations": iterations, "method_options": [f"eta={eta}"], "interpolate": list(own)}
    write(name, points[:, None, :], trace, tolerance, options)


def grid(name, data, tolerance, iterations):
    total = numpy.array([curvature(data[i]) for i in range(len(data))]) ** 2
    total += numpy.array([curvature(data[:, j]) for j in range(data.shape[1])]).T ** 2
    u = Line(numpy.mean([chord(data[:, j]) for j in range(data.shape[1])], axis=0), total.mean(1), ())
    v = Line(numpy.mean([chord(data[i]) for i in range(len(data))], axis=0), total.mean(0), ())
    write(name, data, fit(data, u, v, 0.6, 1, tolerance, iterations), tolerance, {"iterations": iterations})


a = numpy.linspace(0, 2 * math.pi, 90)
petals = numpy.stack([(2 + numpy.cos(5 * a + 0.7)) * numpy.cos(a), (2 + numpy.cos(5 * a)) * numpy.sin(a + 0.1 * numpy.sin(3 * a + 0.3))], axis=1)
curve("petals_6", petals, 0.6, 0.02, 80)
curve("petals_9", petals, 0.9, 0.02, 80, (17, 40))
space = numpy.stack([numpy.cos(3 * a) + a, numpy.sin(2 * a), numpy.sin(3 * a + 1) * a / 4], axis=1)
curve("space", space, 0.6, 0.01, 60)
x, y = numpy.meshgrid(numpy.linspace(0, 3, 24), numpy.linspace(0, 2, 30), indexing="ij")
sheet = numpy.stack([x + 0.05 * numpy.sin(4 * y), y, numpy.sin(3 * x + numpy.cos(4 * y)) + 0.3 * numpy.cos(5 * y * x)], axis=2)
grid("sheet", sheet, 0.02, 40)
