// Reads a STEP or IGES file by OpenCASCADE and prints every B-spline curve and surface it holds, evaluated on a fixed lattice of its domain:
// what another CAD system sees. Usage: read_back FILE SAMPLES. Lines "curve", "surface", "face AREA", then "t x y z" or "u v x y z".
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Reader.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <cstdio>
#include <cstdlib>
#include <cstring>

template <class Reader> static TopoDS_Shape read(const char *path)
{
    Reader reader;
    if (reader.ReadFile(path) != IFSelect_RetDone) std::exit(1);
    reader.TransferRoots();
    return reader.OneShape();
}

static void print_curve(const TopoDS_Edge &edge, int samples)
{
    double first, last;
    Handle(Geom_BSplineCurve) curve = Handle(Geom_BSplineCurve)::DownCast(BRep_Tool::Curve(edge, first, last));
    if (curve.IsNull()) return;
    std::printf("curve\n");
    for (int i = 0; i < samples; i++) {
        double t = i == samples - 1 ? last : first + (last - first) * i / (samples - 1);
        gp_Pnt p = curve->Value(t);
        std::printf("%.17g %.17g %.17g %.17g\n", t, p.X(), p.Y(), p.Z());
    }
}

static void print_face(const TopoDS_Face &face, int samples)
{
    GProp_GProps area;
    BRepGProp::SurfaceProperties(face, area);
    Handle(Geom_BSplineSurface) surface = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
    std::printf("face %.17g %s\nsurface\n", area.Mass(), BRepCheck_Analyzer(face).IsValid() ? "valid" : "broken");
    if (surface.IsNull()) return;
    double u0, u1, v0, v1;
    surface->Bounds(u0, u1, v0, v1);
    for (int i = 0; i < samples; i++)
        for (int j = 0; j < samples; j++) {
            double u = i == samples - 1 ? u1 : u0 + (u1 - u0) * i / (samples - 1), v = j == samples - 1 ? v1 : v0 + (v1 - v0) * j / (samples - 1);
            gp_Pnt p = surface->Value(u, v);
            std::printf("%.17g %.17g %.17g %.17g %.17g\n", u, v, p.X(), p.Y(), p.Z());
        }
}

int main(int argc, char **argv)
{
    if (argc != 3) return 2;
    int iges = std::strstr(argv[1], ".ig") != nullptr;
    TopoDS_Shape shape = iges ? read<IGESControl_Reader>(argv[1]) : read<STEPControl_Reader>(argv[1]);
    bool faces = false;
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
        print_face(TopoDS::Face(e.Current()), std::atoi(argv[2]));
        faces = true;
    }
    for (TopExp_Explorer e(shape, TopAbs_EDGE); !faces && e.More(); e.Next()) print_curve(TopoDS::Edge(e.Current()), std::atoi(argv[2]));
    return 0;
}
