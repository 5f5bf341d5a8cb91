#include "occt.hpp"

#include <stdexcept>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Reader.hxx>

template <class Reader> static TopoDS_Shape read_exchange(const char *path, const char *name)
{
    Reader reader;                                                // which also makes the settings known
    Interface_Static::SetIVal("read.iges.bspline.continuity", 0); // splines stay as they are, corners and all
    if (reader.ReadFile(path) != IFSelect_RetDone)
        throw std::runtime_error(std::string("it is not a ") + name + " file, or a damaged one");
    reader.TransferRoots();
    TopoDS_Shape shape = reader.OneShape();
    if (shape.IsNull()) throw std::runtime_error(std::string("no shape can be made of this ") + name + " file");
    return shape;
}

TopoDS_Shape read_shape(const std::string &format, const char *path)
{
    if (format == "step") return read_exchange<STEPControl_Reader>(path, "STEP");
    if (format == "iges") return read_exchange<IGESControl_Reader>(path, "IGES");
    TopoDS_Shape shape;
    BRep_Builder builder;
    if (format != "brep" || !BRepTools::Read(shape, path, builder) || shape.IsNull())
        throw std::runtime_error("it is not a BREP file, or a damaged one");
    return shape;
}
