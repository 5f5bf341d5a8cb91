// What OpenCASCADE finds in a file, held against the models that were written to it.
#ifndef PIA_CAD_READ_BACK_HPP
#define PIA_CAD_READ_BACK_HPP

#include "shapes.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <IGESControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

typedef std::vector<Model> Models;

inline double extent(const pia_model *model)
{
    double low[3] = {0}, high[3] = {0};
    CHECK(pia_model_bounds(nullptr, model, low, high) == PIA_OK, "bounds");
    return std::sqrt(std::pow(high[0] - low[0], 2) + std::pow(high[1] - low[1], 2) + std::pow(high[2] - low[2], 2));
}

template <class Reader> TopoDS_Shape read(const std::string &path)
{
    Reader reader;
    CHECK(reader.ReadFile(path.c_str()) == IFSelect_RetDone, "%s", path.c_str());
    reader.TransferRoots();
    return reader.OneShape();
}

inline TopoDS_Shape read_shape(const std::string &path)
{
    return path.back() == 's' ? read<IGESControl_Reader>(path) : read<STEPControl_Reader>(path);
}

inline void compare(const pia_model *model, const double *at, const gp_Pnt &theirs, double scale, double near)
{
    double ours[3] = {0};
    CHECK(pia_model_eval(nullptr, model, at, 1, 0, ours) == PIA_OK, "evaluation");
    double off = theirs.Distance(gp_Pnt(scale * ours[0], scale * ours[1], scale * ours[2]));
    CHECK(off <= near, "a point is off by %g at (%g, %g)", off, at[0], at[1]);
}

inline void check_face(const TopoDS_Face &face, const pia_model *model, double scale)
{
    enum { STEPS = 16 };
    CHECK(BRepCheck_Analyzer(face).IsValid(), "a face is broken");
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    pia_model_info info = info_of(model);
    double near = 1e-12 * scale * extent(model);
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= STEPS; j++) {
            const double share[2] = {(double)i / STEPS, (double)j / STEPS};
            double at[2];
            for (int d = 0; d < 2; d++) at[d] = info.domain[d][0] + share[d] * (info.domain[d][1] - info.domain[d][0]);
            compare(model, at, surface->Value(at[0], at[1]), scale, near);
        }
    GProp_GProps area;
    BRepGProp::SurfaceProperties(face, area, 1e-6);
    double expected = scale * scale * area_of(model);
    CHECK(std::fabs(area.Mass() - expected) <= 1e-3 * expected, "an area is %.12g, not %.12g", area.Mass(), expected);
}

inline void check_edge(const TopoDS_Edge &edge, const pia_model *model, double scale)
{
    enum { STEPS = 200 };
    double first, last;
    Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    pia_model_info info = info_of(model);
    double near = 1e-12 * scale * extent(model);
    CHECK(first == info.domain[0][0] && last == info.domain[0][1], "a domain is [%g, %g]", first, last);
    for (int i = 0; i <= STEPS; i++) {
        const double at[2] = {first + (last - first) * i / STEPS, 0};
        compare(model, at, curve->Value(at[0]), scale, near);
    }
}

inline void check_shape(const std::string &path, const Models &models, double scale)
{
    TopoDS_Shape shape = read_shape(path);
    size_t face = 0, edge = 0;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next(), face++) {
        CHECK(face < models.size(), "%s has more faces than models", path.c_str());
        check_face(TopoDS::Face(e.Current()), models[face].get(), scale);
    }
    for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next(), edge++) {
        CHECK(edge < models.size(), "%s has more curves than models", path.c_str());
        check_edge(TopoDS::Edge(e.Current()), models[edge].get(), scale);
    }
    CHECK(face + edge == models.size(), "%s has %zu faces and %zu curves for %zu models", path.c_str(), face, edge, models.size());
}

#endif
