#include "occt.hpp"

#include <cmath>

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepTools.hxx>
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

// A periodic direction is opened where the face begins; the others keep their whole domain.
static void clamp(const TopoDS_Face &face, const Handle(Geom_BSplineSurface) & s)
{
    double face_u[2], face_v[2], u[2], v[2];
    BRepTools::UVBounds(face, face_u[0], face_u[1], face_v[0], face_v[1]);
    s->Bounds(u[0], u[1], v[0], v[1]);
    double period_u = u[1] - u[0], period_v = v[1] - v[0];
    bool was_u = s->IsUPeriodic(), was_v = s->IsVPeriodic();
    if (!was_u && !was_v && is_clamped(s)) return;
    if (was_u) u[0] = face_u[0], u[1] = std::fmin(face_u[1], face_u[0] + period_u);
    if (was_v) v[0] = face_v[0], v[1] = std::fmin(face_v[1], face_v[0] + period_v);
    s->Segment(u[0], u[1], v[0], v[1]);
    if (s->IsUPeriodic()) s->SetUNotPeriodic();
    if (s->IsVPeriodic()) s->SetVNotPeriodic();
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
    clamp(face, surface);
    loops = loops_of(face, surface);
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
