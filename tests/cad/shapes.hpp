// The shapes that go through CAD files in these tests, and their areas by an integration of our own.
#ifndef PIA_CAD_SHAPES_HPP
#define PIA_CAD_SHAPES_HPP

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <pia/pia.h>

typedef std::vector<double> Numbers;

// Ends the test with the place of what does not hold.
#define CHECK(condition, ...)                                                                                                          \
    do {                                                                                                                               \
        if (!(condition)) {                                                                                                            \
            std::fprintf(stderr, "%s:%d: not %s: ", __FILE__, __LINE__, #condition);                                                   \
            std::fprintf(stderr, __VA_ARGS__);                                                                                         \
            std::fprintf(stderr, "\n");                                                                                                \
            std::exit(1);                                                                                                              \
        }                                                                                                                              \
    } while (0)

// Models that end with the test.
class Model
{
  public:
    Model() : model(nullptr)
    {
    }
    explicit Model(pia_model *made) : model(made)
    {
    }
    Model(Model &&other) noexcept : model(other.model)
    {
        other.model = nullptr;
    }
    Model &operator=(Model &&other) noexcept
    {
        return std::swap(model, other.model), *this;
    }
    ~Model()
    {
        pia_model_destroy(model);
    }
    const pia_model *get() const
    {
        return model;
    }

  private:
    pia_model *model;
};

inline pia_model_info info_of(const pia_model *model)
{
    pia_model_info info = {};
    info.struct_size = sizeof info;
    pia_model_get_info(model, &info);
    return info;
}

inline Numbers even_knots(int control, int degree)
{
    Numbers knots(degree + 1, 0.0);
    for (int i = 1; i < control - degree; i++) knots.push_back((double)i / (control - degree));
    knots.insert(knots.end(), degree + 1, 1.0);
    return knots;
}

inline Model make(int directions, const int *degree, const pia_index *control, const Numbers *knots, int dim, const Numbers &points,
                  const Numbers &weights)
{
    const double *const all[2] = {knots[0].data(), directions > 1 ? knots[1].data() : nullptr};
    pia_model *model = nullptr;
    pia_status status = pia_model_create(nullptr, directions, degree, all, control, dim, points.data(),
                                         weights.empty() ? nullptr : weights.data(), &model);
    CHECK(status == PIA_OK, "a shape of the tests");
    return Model(model);
}

inline Model curve(int degree, int control, int dim, bool rational, bool closed)
{
    Numbers points, weights, knots[1] = {even_knots(control, degree)};
    for (int i = 0; i < control; i++) {
        double angle = 2 * M_PI * (closed && i == control - 1 ? 0 : i) / (control - 1);
        const double x[3] = {3 * std::cos(angle), 2 * std::sin(angle), std::sin(3 * angle) + 0.1 * (closed ? 0 : i)};
        points.insert(points.end(), x, x + dim);
        if (rational) weights.push_back(1 + 0.4 * std::sin(2.0 * i));
    }
    const pia_index count[1] = {control};
    return make(1, &degree, count, knots, dim, points, weights);
}

inline Model wavy_surface(int degree_u, int degree_v, bool rational)
{
    const int degree[2] = {degree_u, degree_v};
    const pia_index control[2] = {10, 9};
    Numbers points, weights, knots[2] = {even_knots(10, degree_u), even_knots(9, degree_v)};
    for (int i = 0; i < 10; i++)
        for (int j = 0; j < 9; j++) {
            const double x[3] = {1.0 * i, 1.2 * j, std::sin(1.0 * i) * std::cos(1.0 * j)};
            points.insert(points.end(), x, x + 3);
            if (rational) weights.push_back(1 + 0.3 * std::sin(9.0 * i + j));
        }
    return make(2, degree, control, knots, 3, points, weights);
}

// A profile (radius, height) of degree 2 or 1 turned around the z axis, exactly.
inline Model turned(const Numbers &radius, const Numbers &height, const Numbers &weight, const Numbers &profile_knots)
{
    static const double x[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
    const double s = std::sqrt(0.5);
    int m = (int)radius.size(), p = (int)profile_knots.size() - m - 1;
    const int degree[2] = {2, p};
    const pia_index control[2] = {9, m};
    Numbers points, weights, knots[2] = {{0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1}, profile_knots};
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < m; j++) {
            const double at[3] = {x[i] * radius[j], y[i] * radius[j], height[j]};
            points.insert(points.end(), at, at + 3);
            weights.push_back((i % 2 ? s : 1) * weight[j]);
        }
    return make(2, degree, control, knots, 3, points, weights);
}

inline Model sphere()
{
    const double s = std::sqrt(0.5);
    return turned({0, 1, 1, 1, 0}, {-1, -1, 0, 1, 1}, {1, s, 1, s, 1}, {0, 0, 0, .5, .5, 1, 1, 1});
}

inline Model cylinder()
{
    return turned({1, 1}, {0, 2}, {1, 1}, {0, 0, 1, 1});
}

inline Model cone()
{
    return turned({1, 0}, {0, 2}, {1, 1}, {0, 0, 1, 1});
}

inline Model torus()
{
    const double s = std::sqrt(0.5);
    return turned({4, 4, 3, 2, 2, 2, 3, 4, 4}, {0, 1, 1, 1, 0, -1, -1, -1, 0}, {1, s, 1, s, 1, s, 1, s, 1},
                  {0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1});
}

inline Model trimmed(Model whole, const std::vector<Numbers> &loops)
{
    std::vector<pia_index> counts;
    Numbers uv;
    for (const Numbers &loop : loops) {
        counts.push_back((pia_index)loop.size() / 2);
        uv.insert(uv.end(), loop.begin(), loop.end());
    }
    pia_model *model = nullptr;
    pia_status status = pia_model_trim(nullptr, whole.get(), (pia_index)loops.size(), counts.data(), uv.data(), &model);
    CHECK(status == PIA_OK, "loops of the tests");
    return Model(model);
}

inline Numbers star()
{
    Numbers loop;
    for (int i = 0; i < 24; i++) {
        double radius = i % 2 ? 0.45 : 0.3, angle = 2 * M_PI * i / 24;
        loop.push_back(0.5 + radius * std::cos(angle));
        loop.push_back(0.5 + radius * std::sin(angle));
    }
    return loop;
}

// ---- areas ----

// |Su x Sv|
inline double density(const pia_model *model, double u, double v)
{
    const double at[2] = {u, v};
    double d[9];
    pia_status status = pia_model_eval(nullptr, model, at, 1, 1, d);
    CHECK(status == PIA_OK, "derivatives");
    const double *a = d + 3, *b = d + 6;
    return std::sqrt(std::pow(a[1] * b[2] - a[2] * b[1], 2) + std::pow(a[2] * b[0] - a[0] * b[2], 2) +
                     std::pow(a[0] * b[1] - a[1] * b[0], 2));
}

static const double gauss_at[] = {-0.906179845938664, -0.5384693101056831, 0, 0.5384693101056831, 0.906179845938664};
static const double gauss_weight[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                      0.2369268850561891};

// Where u enters and leaves the face on the line of this v.
inline Numbers cuts(const pia_model *model, double v)
{
    Numbers at;
    pia_model_info info = info_of(model);
    for (pia_index l = 0; l < pia_model_trim_loop_count(model); l++) {
        pia_index count;
        const double *uv = pia_model_trim_loop(model, l, &count);
        for (pia_index i = 0; i < count; i++) {
            const double *a = uv + 2 * i, *b = uv + 2 * ((i + 1) % count);
            if ((a[1] > v) != (b[1] > v)) at.push_back(a[0] + (v - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
        }
    }
    if (pia_model_trim_loop_count(model) == 0) at = {info.domain[0][0], info.domain[0][1]};
    std::sort(at.begin(), at.end());
    return at;
}

inline double along_u(const pia_model *model, double from, double to, double v)
{
    Numbers ends = {from, to};
    const double *knots = pia_model_knots(model, 0);
    for (pia_index i = 0; i < info_of(model).knot_count[0]; i++)
        if (knots[i] > from && knots[i] < to) ends.push_back(knots[i]);
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (size_t i = 1; i < ends.size(); i++)
        for (int g = 0; g < 5; g++) {
            double half = (ends[i] - ends[i - 1]) / 2;
            sum += half * gauss_weight[g] * density(model, ends[i - 1] + half * (1 + gauss_at[g]), v);
        }
    return sum;
}

// The area of the face: Gauss points between all places where something bends.
inline double area_of(const pia_model *model)
{
    pia_model_info info = info_of(model);
    Numbers ends(pia_model_knots(model, 1), pia_model_knots(model, 1) + info.knot_count[1]);
    for (pia_index l = 0; l < pia_model_trim_loop_count(model); l++) {
        pia_index count;
        const double *uv = pia_model_trim_loop(model, l, &count);
        for (pia_index i = 0; i < count; i++) ends.push_back(uv[2 * i + 1]);
    }
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (size_t i = 1; i < ends.size(); i++)
        for (int g = 0; g < 5 && ends[i] > ends[i - 1]; g++) {
            double half = (ends[i] - ends[i - 1]) / 2, v = ends[i - 1] + half * (1 + gauss_at[g]);
            Numbers at = cuts(model, v);
            for (size_t k = 1; k < at.size(); k += 2) sum += half * gauss_weight[g] * along_u(model, at[k - 1], at[k], v);
        }
    return sum;
}

#endif
