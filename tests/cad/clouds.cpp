// Unordered clouds to trimmed STEP and IGES files by one command each, read by OpenCASCADE: every face valid, geometry equal to 1e-12
// of the extent, areas right. Usage: clouds FOLDER PIA [CLOUD.csv]...
#include "read_back.hpp"

#include <IGESControl_Controller.hxx>
#include <Interface_Static.hxx>

#include <fstream>
#include <functional>
#include <random>
#include <sstream>

// Points of a patch over (u, v) in [0, 1]^2 and the options that go with them; area 0 where none is known.
struct Cloud {
    const char *name, *options;
    int rows, columns;
    double area;
    std::function<gp_Pnt(double, double)> at;
};

static std::vector<Cloud> clouds()
{
    return {
        {"cap", "", 33, 33, 2 * M_PI * 25 * (1 - std::cos(0.9)),
         [](double u, double v) { // of a sphere, about its pole: a square made round
             double a = 2 * u - 1, b = 2 * v - 1, x = a * std::sqrt(1 - b * b / 2), y = b * std::sqrt(1 - a * a / 2);
             double r = std::hypot(x, y), spread = r > 0 ? std::sin(0.9 * r) / r : 0.9;
             return gp_Pnt(5 * x * spread, 5 * y * spread, 5 * std::cos(0.9 * r));
         }},
        {"torus", "", 30, 40, 0,
         [](double u, double v) {
             double a = 1.2 * u - 0.6, b = 1.6 * v - 0.8;
             return gp_Pnt((5 + 2 * std::cos(b)) * std::cos(a), (5 + 2 * std::cos(b)) * std::sin(a), 2 * std::sin(b));
         }},
        {"vase", "", 24, 60, 0,
         [](double u, double v) { // all around, its ends open and slanted
             double turn = 2 * M_PI * v, height = u * (6 + 0.7 * std::cos(turn)), radius = 2 + 0.5 * std::sin(height);
             return gp_Pnt(radius * std::cos(turn), radius * std::sin(turn), height);
         }},
        {"window", "--param xy", 40, 40, 0,
         [](double u, double v) { // with a hole
             double x = u - 0.5, y = v - 0.5, r = std::hypot(x, y);
             if (r < 0.2) x *= 0.2 / r, y *= 0.2 / r;
             return gp_Pnt(10 * x, 10 * y, std::sin(8 * x) * std::cos(5 * y));
         }},
        {"plateau", "--param xy", 45, 45, 0,
         [](double u, double v) { // walls too steep for its parameters
             double height = 1 / (1 + std::exp(-60 * (0.3 - std::hypot(u - 0.5, v - 0.5))));
             return gp_Pnt(10 * u, 10 * v, 2 * height);
         }},
    };
}

// Rows in an order that says nothing.
static void write_rows(const std::string &path, std::vector<std::string> rows)
{
    std::shuffle(rows.begin(), rows.end(), std::mt19937(1));
    std::ofstream out(path);
    for (const std::string &row : rows) out << row << '\n';
    CHECK(out.flush(), "%s is not written", path.c_str());
}

static std::vector<std::string> rows_of(const Cloud &cloud)
{
    std::vector<std::string> rows;
    for (int i = 0; i < cloud.rows; i++)
        for (int j = 0; j < cloud.columns; j++) {
            gp_Pnt p = cloud.at((double)i / (cloud.rows - 1), (double)j / (cloud.columns - 1));
            std::ostringstream row;
            row.precision(17);
            row << p.X() << ',' << p.Y() << ',' << p.Z();
            rows.push_back(row.str());
        }
    return rows;
}

static std::vector<std::string> rows_of(const char *path)
{
    std::vector<std::string> rows;
    std::ifstream in(path);
    std::string row;
    std::getline(in, row); // the heading
    while (std::getline(in, row)) rows.push_back(row);
    CHECK(!rows.empty(), "%s has no points", path);
    return rows;
}

static double extent_of(const std::vector<std::string> &rows)
{
    double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300}, sum = 0;
    for (const std::string &row : rows) {
        const char *at = row.c_str();
        for (int d = 0; d < 3; d++) {
            char *end;
            double x = std::strtod(at, &end);
            low[d] = std::min(low[d], x);
            high[d] = std::max(high[d], x);
            at = *end == ',' ? end + 1 : end;
        }
    }
    for (int d = 0; d < 3; d++) sum += (high[d] - low[d]) * (high[d] - low[d]);
    return std::sqrt(sum);
}

static Models read_models(const std::string &path)
{
    pia_model **list = nullptr;
    pia_index count = 0;
    pia_status status = pia_model_read(nullptr, path.c_str(), nullptr, &list, &count);
    CHECK(status == PIA_OK && count == 1, "%s: %s", path.c_str(), pia_strerror(status));
    Models all;
    const pia_index loops = pia_model_trim_loop_count(list[0]);
    CHECK(loops > 0, "%s is not trimmed", path.c_str());
    pia_model *copy = nullptr;
    CHECK(pia_model_insert_knots(nullptr, list[0], 0, nullptr, 0, &copy) == PIA_OK, "a copy");
    all.push_back(Model(copy));
    pia_models_destroy(list, count);
    return all;
}

// To one hundredth of the extent, as a true distance.
static double check_cloud(const std::string &stem, const std::string &pia, const std::string &options,
                          const std::vector<std::string> &rows)
{
    write_rows(stem + ".csv", rows);
    std::ostringstream command;
    command << "'" << pia << "' fit '" << stem << ".csv' --surface --quiet --measure distance --tolerance " << 1e-2 * extent_of(rows)
            << ' ' << options;
    for (const char *kind : {".step", ".igs", ".json"}) command << " -o '" << stem << kind << "'";
    command << " >'" << stem << ".said'";
    int code = std::system(command.str().c_str());
    CHECK(code == 0, "status %d of %s", code, command.str().c_str());
    Models models = read_models(stem + ".json");
    check_shape(stem + ".step", models, 1);
    check_shape(stem + ".igs", models, 1);
    return area_of(models[0].get());
}

static std::string stem_of(const std::string &folder, const std::string &path)
{
    size_t slash = path.rfind('/'), dot = path.rfind('.');
    return folder + "/" + path.substr(slash + 1, dot - slash - 1);
}

int main(int argc, char **argv)
{
    if (argc < 3) return 2;
    std::string folder = argv[1], pia = argv[2];
    IGESControl_Controller::Init();
    Interface_Static::SetIVal("read.iges.bspline.continuity", 0); // splines as they are in the file
    for (const Cloud &cloud : clouds()) {
        double area = check_cloud(folder + "/" + cloud.name, pia, cloud.options, rows_of(cloud));
        std::printf("%s: area %.6g\n", cloud.name, area);
        if (cloud.area > 0) CHECK(std::fabs(area - cloud.area) < 0.05 * cloud.area, "the outline is off: %g, not %g", area, cloud.area);
    }
    for (int i = 3; i < argc; i++) {
        const std::vector<std::string> rows = rows_of(argv[i]);
        std::string options = std::string(argv[i]).find("gcode") != std::string::npos ? "--param xy" : "";
        std::printf("%s: area %.6g\n", argv[i], check_cloud(stem_of(folder, argv[i]), pia, options, rows));
    }
    return 0;
}
