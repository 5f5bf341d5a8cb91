// pia-occt FORMAT PATH: every curve and surface of a STEP, IGES or BREP file, as records on descriptor 3. Started by the library.
#include "occt.hpp"

#include <cstdio>
#include <exception>

#include <Standard_Failure.hxx>
#include <TopAbs.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "plugin_limit.h"

static void send_all(const TopoDS_Shape &shape)
{
    for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
        std::vector<Loop> loops;
        Handle(Geom_BSplineSurface) surface = surface_of(TopoDS::Face(e.Current()), loops);
        if (!surface.IsNull()) send_surface(surface, loops);
    }
    for (TopExp_Explorer e(shape, TopAbs_EDGE, TopAbs_FACE); e.More(); e.Next()) {
        Handle(Geom_BSplineCurve) curve = curve_of(TopoDS::Edge(e.Current()));
        if (!curve.IsNull()) send_curve(curve);
    }
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        std::fprintf(stderr, "usage: pia-occt step|iges|brep PATH 3>RECORDS\n");
        return 2;
    }
    plugin_limit(argv[2], 20000, 200);
    try {
        send_all(read_shape(argv[1], argv[2]));
        send_end();
        return 0;
    } catch (const Standard_Failure &failure) {
        send_error(std::string("OpenCASCADE gave up: ") + failure.GetMessageString());
    } catch (const std::bad_alloc &) {
        send_error("the file asks for more memory than a file of its size can need");
    } catch (const std::exception &failure) {
        send_error(failure.what());
    }
    return 1;
}
