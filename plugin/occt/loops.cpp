#include "occt.hpp"

#include <algorithm>
#include <cmath>

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <TopAbs.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Wire.hxx>

namespace
{

// A curve in the parameter plane, as chords that leave it by at most this share of the domain.
const double chord_error = 1e-5;
const int deepest = 12;

struct Domain {
    double low[2], size[2];
};

Domain domain_of(const Handle(Geom_BSplineSurface) & surface)
{
    double u[2], v[2];
    surface->Bounds(u[0], u[1], v[0], v[1]);
    return {{u[0], v[0]}, {u[1] - u[0], v[1] - v[0]}};
}

double distance_to_chord(const gp_Pnt2d &p, const gp_Pnt2d &a, const gp_Pnt2d &b, const Domain &domain)
{
    double x = (p.X() - (a.X() + b.X()) / 2) / domain.size[0], y = (p.Y() - (a.Y() + b.Y()) / 2) / domain.size[1];
    double dx = (b.X() - a.X()) / domain.size[0], dy = (b.Y() - a.Y()) / domain.size[1], length = std::hypot(dx, dy);
    return length > 0 ? std::fabs(x * dy - y * dx) / length : std::hypot(x, y);
}

void push(Loop &loop, const gp_Pnt2d &p)
{
    loop.push_back(p.X());
    loop.push_back(p.Y());
}

// The points after `a` up to `b`: halved until three places between lie on the chord.
void add_chords(const Handle(Geom2d_Curve) & curve, double a, double b, int depth, const Domain &domain, Loop &loop)
{
    gp_Pnt2d from = curve->Value(a), to = curve->Value(b);
    double worst = 0;
    for (int k = 1; k <= 3; k++) worst = std::max(worst, distance_to_chord(curve->Value(a + (b - a) * k / 4), from, to, domain));
    if (depth >= deepest || worst <= chord_error) return push(loop, to);
    add_chords(curve, a, (a + b) / 2, depth + 1, domain, loop);
    add_chords(curve, (a + b) / 2, b, depth + 1, domain, loop);
}

// Parameters between which the curve is smooth, from first to last: the knots of a spline.
std::vector<double> stretches(const Handle(Geom2d_Curve) & given, double first, double last)
{
    std::vector<double> at(1, first);
    Handle(Geom2d_Curve) curve = given;
    Handle(Geom2d_TrimmedCurve) part = Handle(Geom2d_TrimmedCurve)::DownCast(curve);
    if (!part.IsNull()) curve = part->BasisCurve();
    Handle(Geom2d_BSplineCurve) spline = Handle(Geom2d_BSplineCurve)::DownCast(curve);
    for (int k = 1; !spline.IsNull() && k <= spline->NbKnots(); k++)
        if (spline->Knot(k) > first && spline->Knot(k) < last) at.push_back(spline->Knot(k));
    at.push_back(last);
    return at;
}

void add_edge(const TopoDS_Edge &edge, const TopoDS_Face &face, const Domain &domain, Loop &loop)
{
    double first, last;
    Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (curve.IsNull()) return;
    Loop forth;
    std::vector<double> at = stretches(curve, first, last);
    push(forth, curve->Value(first));
    for (size_t k = 1; k < at.size(); k++) add_chords(curve, at[k - 1], at[k], 0, domain, forth);
    size_t points = forth.size() / 2;
    bool back = edge.Orientation() == TopAbs_REVERSED;
    for (size_t i = 0; i + 1 < points; i++) {
        size_t from = back ? points - 1 - i : i; // the last point is the first of the next edge
        loop.push_back(forth[2 * from]);
        loop.push_back(forth[2 * from + 1]);
    }
}

// Whether the way from a over b to c goes back along itself.
bool turns_back(const double *a, const double *b, const double *c)
{
    double ab[2] = {b[0] - a[0], b[1] - a[1]}, bc[2] = {c[0] - b[0], c[1] - b[1]};
    return ab[0] * bc[1] - ab[1] * bc[0] == 0 && ab[0] * bc[0] + ab[1] * bc[1] <= 0;
}

// Spikes are taken away from their tips on: what moved onto the border may run there and back.
Loop without_spikes(const Loop &loop)
{
    Loop kept;
    for (size_t i = 0; i < loop.size(); i += 2) {
        kept.insert(kept.end(), {loop[i], loop[i + 1]});
        for (size_t n = kept.size(); n >= 6 && turns_back(&kept[n - 6], &kept[n - 4], &kept[n - 2]); n = kept.size())
            kept.erase(kept.end() - 4, kept.end() - 2);
    }
    while (kept.size() >= 6 && turns_back(&kept[kept.size() - 4], &kept[kept.size() - 2], &kept[0])) kept.resize(kept.size() - 2);
    while (kept.size() >= 6 && turns_back(&kept[kept.size() - 2], &kept[0], &kept[2])) kept.erase(kept.begin(), kept.begin() + 2);
    return kept;
}

} // namespace

std::vector<Loop> loops_of(const TopoDS_Face &oriented, const Handle(Geom_BSplineSurface) & surface)
{
    TopoDS_Face face = TopoDS::Face(oriented.Oriented(TopAbs_FORWARD));
    TopoDS_Wire outer = BRepTools::OuterWire(face);
    Domain domain = domain_of(surface);
    std::vector<Loop> loops;
    for (TopExp_Explorer w(face, TopAbs_WIRE); w.More(); w.Next()) {
        TopoDS_Wire wire = TopoDS::Wire(w.Current());
        Loop loop;
        for (BRepTools_WireExplorer e(wire, face); e.More(); e.Next()) add_edge(e.Current(), face, domain, loop);
        if (loop.size() < 6) continue;
        loops.insert(wire.IsSame(outer) ? loops.begin() : loops.end(), loop);
    }
    return loops;
}

void put_on_border(std::vector<Loop> &loops, const Handle(Geom_BSplineSurface) & surface)
{
    Domain domain = domain_of(surface);
    for (Loop &loop : loops) {
        for (size_t i = 0; i < loop.size(); i++) {
            int d = i % 2;
            double low = domain.low[d], high = low + domain.size[d], near = 1e-6 * domain.size[d];
            if (loop[i] <= low + near) loop[i] = low;
            if (loop[i] >= high - near) loop[i] = high;
        }
        loop = without_spikes(loop);
    }
}
