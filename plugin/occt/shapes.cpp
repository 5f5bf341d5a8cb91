#include "occt.hpp"

#include <cmath>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopAbs.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

static Handle(Geom_BSplineSurface) spline_under(const TopoDS_Face &face)
{
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    Handle(Geom_RectangularTrimmedSurface) part = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface);
    if (!part.IsNull()) surface = part->BasisSurface();
    return Handle(Geom_BSplineSurface)::DownCast(surface);
}

// A face on a plane, a cylinder, ... becomes one on a rational B-spline, its curves in the parameter plane with it.
static TopoDS_Face with_spline(const TopoDS_Face &face)
{
    if (!spline_under(face).IsNull()) return face;
    BRepBuilderAPI_NurbsConvert convert(face, Standard_True);
    TopExp_Explorer e(convert.Shape(), TopAbs_FACE);
    return e.More() ? TopoDS::Face(e.Current()) : TopoDS_Face();
}

static bool is_clamped(const Handle(Geom_BSplineSurface) & s)
{
    return s->UMultiplicity(1) == s->UDegree() + 1 && s->UMultiplicity(s->NbUKnots()) == s->UDegree() + 1 &&
           s->VMultiplicity(1) == s->VDegree() + 1 && s->VMultiplicity(s->NbVKnots()) == s->VDegree() + 1;
}

// Whether weights agree at both ends of a direction: only then does making it periodic keep the shape.
static bool ends_alike(const Handle(Geom_BSplineSurface) & s, int d)
{
    int lines = d == 0 ? s->NbVPoles() : s->NbUPoles(), last = d == 0 ? s->NbUPoles() : s->NbVPoles();
    for (int k = 1; k <= lines; k++)
        if (d == 0 ? s->Weight(1, k) != s->Weight(last, k) : s->Weight(k, 1) != s->Weight(k, last)) return false;
    return d == 0 ? s->IsUClosed() : s->IsVClosed();
}

struct Range {
    double low, high;
};

static Range range_of(const Loop &loop, int d)
{
    Range r = {loop[d], loop[d]};
    for (size_t i = d; i < loop.size(); i += 2) r = {std::fmin(r.low, loop[i]), std::fmax(r.high, loop[i])};
    return r;
}

static void shift(Loop &loop, int d, double by)
{
    for (size_t i = d; i < loop.size(); i += 2) loop[i] += by;
}

// Holes of a periodic surface come into the turn of the outer loop; the range of them all, one turn at most.
static Range gather(std::vector<Loop> &loops, int d, double period)
{
    Range all = range_of(loops[0], d);
    double middle = (all.low + all.high) / 2;
    for (size_t l = 1; l < loops.size(); l++) {
        Range r = range_of(loops[l], d);
        shift(loops[l], d, period * std::round((middle - (r.low + r.high) / 2) / period));
        r = range_of(loops[l], d);
        all = {std::fmin(all.low, r.low), std::fmax(all.high, r.high)};
    }
    return {all.low, std::fmin(all.high, all.low + period)};
}

// The stretch of direction d that holds the face: the whole domain, or of a periodic direction what the loops need. A closed direction
// whose loops leave the domain is periodic in all but name.
static Range stretch_of(const Handle(Geom_BSplineSurface) & s, std::vector<Loop> &loops, int d)
{
    double u[2], v[2];
    s->Bounds(u[0], u[1], v[0], v[1]);
    Range domain = {d == 0 ? u[0] : v[0], d == 0 ? u[1] : v[1]};
    double size = domain.high - domain.low;
    bool inside = true;
    for (const Loop &loop : loops) {
        Range r = range_of(loop, d);
        inside = inside && r.low >= domain.low - 1e-6 * size && r.high <= domain.high + 1e-6 * size;
    }
    bool periodic = d == 0 ? s->IsUPeriodic() : s->IsVPeriodic();
    if (!periodic && !inside && ends_alike(s, d)) {
        if (d == 0)
            s->SetUPeriodic();
        else
            s->SetVPeriodic();
        periodic = true;
    }
    return periodic && !loops.empty() ? gather(loops, d, size) : domain;
}

// Clamped and not periodic, the loops where the surface then is.
static void clamp(const Handle(Geom_BSplineSurface) & s, std::vector<Loop> &loops)
{
    Range u = stretch_of(s, loops, 0), v = stretch_of(s, loops, 1);
    if (!s->IsUPeriodic() && !s->IsVPeriodic() && is_clamped(s)) return;
    bool was_u = s->IsUPeriodic(), was_v = s->IsVPeriodic();
    s->Segment(u.low, u.high, v.low, v.high);
    if (s->IsUPeriodic()) s->SetUNotPeriodic();
    if (s->IsVPeriodic()) s->SetVNotPeriodic();
    double low_u, high_u, low_v, high_v;
    s->Bounds(low_u, high_u, low_v, high_v);
    for (Loop &loop : loops) {
        if (was_u) shift(loop, 0, low_u - u.low);
        if (was_v) shift(loop, 1, low_v - v.low);
    }
}

static double area_of(const Loop &loop)
{
    double area = 0;
    for (size_t i = 0; i < loop.size(); i += 2) {
        size_t next = (i + 2) % loop.size();
        area += (loop[i] * loop[next + 1] - loop[next] * loop[i + 1]) / 2;
    }
    return std::fabs(area);
}

// Whether the loops cut nothing off the domain.
static bool is_whole(const std::vector<Loop> &loops, const Handle(Geom_BSplineSurface) & surface)
{
    double u[2], v[2];
    surface->Bounds(u[0], u[1], v[0], v[1]);
    double domain = (u[1] - u[0]) * (v[1] - v[0]);
    return loops.empty() || (loops.size() == 1 && area_of(loops[0]) >= domain * (1 - 1e-6));
}

Handle(Geom_BSplineSurface) surface_of(const TopoDS_Face &given, std::vector<Loop> &loops)
{
    TopoDS_Face face = with_spline(given);
    if (face.IsNull()) return Handle(Geom_BSplineSurface)();
    Handle(Geom_BSplineSurface) under = spline_under(face);
    if (under.IsNull()) return under;
    Handle(Geom_BSplineSurface) surface = Handle(Geom_BSplineSurface)::DownCast(under->Copy());
    loops = loops_of(face, surface);
    clamp(surface, loops);
    put_on_border(loops, surface);
    if (is_whole(loops, surface)) loops.clear();
    return surface;
}

Handle(Geom_BSplineCurve) curve_of(const TopoDS_Edge &edge)
{
    double first, last;
    Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull() || !(last - first > Precision::PConfusion())) return Handle(Geom_BSplineCurve)();
    Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve);
    bool whole = !spline.IsNull() && !spline->IsPeriodic() && std::fabs(first - spline->FirstParameter()) <= Precision::PConfusion() &&
                 std::fabs(last - spline->LastParameter()) <= Precision::PConfusion();
    if (!whole) spline = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, first, last));
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    if (spline->Multiplicity(1) <= spline->Degree() || spline->Multiplicity(spline->NbKnots()) <= spline->Degree()) {
        spline = Handle(Geom_BSplineCurve)::DownCast(spline->Copy());
        spline->Segment(spline->FirstParameter(), spline->LastParameter());
    }
    return spline;
}
