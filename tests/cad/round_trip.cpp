// Models written as STEP and IGES, read by OpenCASCADE itself: every face valid, geometry equal to 1e-12 of the extent, areas right;
// then read back by the library; then shapes that OpenCASCADE made. Usage: round_trip FOLDER
#include "read_back.hpp"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Writer.hxx>
#include <gp_Ax2.hxx>

static pia_context *context;

static Models curves()
{
    Models all;
    all.push_back(curve(3, 12, 3, false, false));
    all.push_back(curve(2, 7, 2, true, false));
    all.push_back(curve(5, 14, 3, true, true));
    all.push_back(curve(1, 9, 3, false, false)); // corners
    return all;
}

static Models surfaces()
{
    const Numbers hole = {0.45, 0.45, 0.45, 0.55, 0.6, 0.5};
    Models all;
    all.push_back(wavy_surface(3, 3, false));
    all.push_back(wavy_surface(2, 4, true));
    all.push_back(sphere());
    all.push_back(torus());
    all.push_back(cylinder());
    all.push_back(cone());
    all.push_back(trimmed(wavy_surface(3, 3, false), {star(), hole}));
    all.push_back(trimmed(wavy_surface(5, 2, true), {star(), hole}));
    all.push_back(trimmed(wavy_surface(1, 3, false), {{0, 0, 1, 0, 1, 0.5, 0.5, 1, 0, 1}})); // along the border
    all.push_back(trimmed(sphere(), {{0, 0.5, 0.25, 0.5, 0.25, 1, 0, 1}}));                  // at a pole
    all.push_back(trimmed(cylinder(), {{0, 0, 1, 0, 1, 0.6, 0.5, 0.9, 0, 0.6}}));            // across the seam
    all.push_back(trimmed(torus(), {{0.2, 0.2, 0.7, 0.3, 0.6, 0.8}, {0.5, 0.4, 0.5, 0.5, 0.55, 0.5}}));
    return all;
}

static void write(const std::string &path, const Models &models, pia_step_schema schema, pia_unit unit)
{
    std::vector<const pia_model *> list;
    for (const Model &model : models) list.push_back(model.get());
    pia_write_options options;
    pia_write_options_init(&options);
    options.step_schema = schema;
    options.unit = unit;
    pia_status status = pia_model_write_as(context, path.c_str(), list.data(), (pia_index)list.size(), &options);
    CHECK(status == PIA_OK, "%s: %s", path.c_str(), pia_message(context));
}

// ---- read by the library ----

static Models read_models(const std::string &path)
{
    pia_model **list = nullptr;
    pia_index count = 0;
    pia_status status = pia_model_read(context, path.c_str(), nullptr, &list, &count);
    CHECK(status == PIA_OK, "%s: %s", path.c_str(), pia_message(context));
    Models all;
    for (pia_index k = 0; k < count; k++) {
        pia_model *copy = nullptr;
        CHECK(pia_model_insert_knots(context, list[k], 0, nullptr, 0, &copy) == PIA_OK, "a copy");
        all.push_back(Model(copy));
    }
    pia_models_destroy(list, count);
    return all;
}

static void check_model(const pia_model *back, const pia_model *model, double scale)
{
    enum { STEPS = 16 };
    pia_model_info info = info_of(back);
    CHECK(info.directions == info_of(model).directions && info.rational == info_of(model).rational, "another kind of model");
    double near = 1e-12 * scale * extent(model);
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= (info.directions == 2 ? STEPS : 0); j++) {
            double at[2] = {info.domain[0][0] + (info.domain[0][1] - info.domain[0][0]) * i / STEPS,
                            info.domain[1][0] + (info.domain[1][1] - info.domain[1][0]) * j / STEPS},
                   x[3];
            CHECK(pia_model_eval(context, back, at, 1, 0, x) == PIA_OK, "evaluation");
            compare(model, at, gp_Pnt(x[0], x[1], x[2]), scale, near);
        }
    CHECK(pia_model_trim_loop_count(back) == pia_model_trim_loop_count(model), "another number of loops");
    if (info.directions == 1) return;
    double expected = scale * scale * area_of(model);
    CHECK(std::fabs(area_of(back) - expected) <= 1e-6 * expected, "an area is %.12g, not %.12g", area_of(back), expected);
}

static void check_models(const std::string &path, const Models &models, double scale)
{
    Models back = read_models(path);
    CHECK(back.size() == models.size(), "%s has %zu models, not %zu", path.c_str(), back.size(), models.size());
    for (size_t k = 0; k < models.size(); k++) check_model(back[k].get(), models[k].get(), scale);
}

static void check_round_trip(const std::string &path, const Models &models, pia_step_schema schema, pia_unit unit, double scale)
{
    write(path, models, schema, unit);
    check_shape(path, models, scale);
    check_models(path, models, scale);
}

// ---- shapes of OpenCASCADE ----

// Faces that are no splines, trimmed by circles and by the curves where cylinders meet: all faces come, with the area of the shape.
static void check_solid(const std::string &path, const TopoDS_Shape &solid)
{
    GProp_GProps whole;
    BRepGProp::SurfaceProperties(solid, whole, 1e-6);
    size_t faces = 0;
    for (TopExp_Explorer e(solid, TopAbs_FACE); e.More(); e.Next()) faces++;
    double area = 0;
    Models models = read_models(path);
    CHECK(models.size() == faces, "%s has %zu faces, not %zu", path.c_str(), models.size(), faces);
    for (const Model &model : models) area += area_of(model.get());
    CHECK(std::fabs(area - whole.Mass()) <= 1e-3 * area, "%s: the area is %.12g, not %.12g", path.c_str(), area, whole.Mass());
}

static void check_foreign(const std::string &name, const TopoDS_Shape &solid)
{
    CHECK(BRepTools::Write(solid, (name + ".brep").c_str()), "no BREP file");
    STEPControl_Writer step;
    step.Transfer(solid, STEPControl_AsIs);
    CHECK(step.Write((name + ".step").c_str()) == IFSelect_RetDone, "no STEP file");
    IGESControl_Writer iges;
    CHECK(iges.AddShape(solid), "no IGES model");
    iges.ComputeModel();
    CHECK(iges.Write((name + ".igs").c_str()), "no IGES file");
    for (const char *kind : {".brep", ".step", ".igs"}) check_solid(name + kind, solid);
}

int main(int argc, char **argv)
{
    if (argc != 2) return 2;
    std::string folder = argv[1];
    CHECK(pia_context_create(nullptr, &context) == PIA_OK, "no context");
    IGESControl_Controller::Init();
    Interface_Static::SetIVal("read.iges.bspline.continuity", 0); // splines as they are in the file
    Models lines = curves(), faces = surfaces();
    check_round_trip(folder + "/curves.step", lines, PIA_STEP_AP214, PIA_UNIT_MILLIMETRE, 1);
    check_round_trip(folder + "/curves.igs", lines, PIA_STEP_AP214, PIA_UNIT_MILLIMETRE, 1);
    check_round_trip(folder + "/faces.step", faces, PIA_STEP_AP214, PIA_UNIT_MILLIMETRE, 1);
    check_round_trip(folder + "/faces.igs", faces, PIA_STEP_AP214, PIA_UNIT_MILLIMETRE, 1);
    check_round_trip(folder + "/inch.step", faces, PIA_STEP_AP242, PIA_UNIT_INCH, 25.4);
    check_round_trip(folder + "/metre.igs", faces, PIA_STEP_AP214, PIA_UNIT_METRE, 1000);
    TopoDS_Shape rod = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-5, 0, 4), gp_Dir(1, 0, 0)), 1.2, 10).Shape();
    check_foreign(folder + "/can", BRepPrimAPI_MakeCylinder(2, 5).Shape());
    check_foreign(folder + "/cross", BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(2, 9).Shape(), rod).Shape());
    pia_context_destroy(context);
    std::printf("STEP, IGES and BREP read back\n");
    return 0;
}
