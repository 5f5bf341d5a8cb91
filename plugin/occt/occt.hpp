// The parts of the reader of CAD files: a program of its own, so that nothing a file does to OpenCASCADE reaches who reads it.
#ifndef PIA_OCCT_HPP
#define PIA_OCCT_HPP

#include <cstdint>
#include <string>
#include <vector>

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

// A closed polyline in the parameter plane: u, v, u, v, ...
typedef std::vector<double> Loop;

// Throws std::runtime_error with a sentence when the file cannot be read. format: "step", "iges" or "brep".
TopoDS_Shape read_shape(const std::string &format, const char *path);

// A face's surface, clamped and not periodic, over a domain that holds the face, and the face's loops; none where the face is the whole
// surface. Null when it cannot be had.
Handle(Geom_BSplineSurface) surface_of(const TopoDS_Face &face, std::vector<Loop> &loops);
// The stretch of a curve that an edge is, clamped and not periodic. Null for edges without length.
Handle(Geom_BSplineCurve) curve_of(const TopoDS_Edge &edge);
// The wires of a face on this surface, the outer one first, as the file has them: on a periodic surface in any turn.
std::vector<Loop> loops_of(const TopoDS_Face &face, const Handle(Geom_BSplineSurface) & surface);
// No face leaves the domain of its surface; its curves in the parameter plane may, by what the file or a conversion is off. They then
// end on the border, exactly.
void put_on_border(std::vector<Loop> &loops, const Handle(Geom_BSplineSurface) & surface);

// Records (see occt_records.h). They throw std::runtime_error when nobody listens.
void send_surface(const Handle(Geom_BSplineSurface) & surface, const std::vector<Loop> &loops);
void send_curve(const Handle(Geom_BSplineCurve) & curve);
void send_error(const std::string &text);
void send_end();

#endif
