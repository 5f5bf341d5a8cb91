#include "occt.hpp"

#include <cerrno>
#include <stdexcept>
#include <unistd.h>

#include "occt_records.h"
#include "plugin_channel.h"

static void send_bytes(const void *bytes, size_t size)
{
    const char *at = static_cast<const char *>(bytes);
    while (size > 0) {
        ssize_t written = write(PIA_PLUGIN_CHANNEL, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw std::runtime_error("nobody reads the records");
        at += written;
        size -= static_cast<size_t>(written);
    }
}

static void send_integers(const std::vector<int64_t> &values)
{
    send_bytes(values.data(), values.size() * sizeof(int64_t));
}

static void send_doubles(const std::vector<double> &values)
{
    send_bytes(values.data(), values.size() * sizeof(double));
}

// Knots as often as they count.
template <class Values, class Counts> static void send_knots(const Values &knots, const Counts &multiplicities)
{
    std::vector<double> flat;
    for (int i = knots.Lower(); i <= knots.Upper(); i++) flat.insert(flat.end(), multiplicities(i), knots(i));
    send_doubles(flat);
}

static void add_point(std::vector<double> &points, const gp_Pnt &p)
{
    points.push_back(p.X());
    points.push_back(p.Y());
    points.push_back(p.Z());
}

void send_surface(const Handle(Geom_BSplineSurface) & s, const std::vector<Loop> &loops)
{
    bool rational = s->IsURational() || s->IsVRational();
    send_integers({PIA_OCCT_SPLINE, 2, rational, s->UDegree(), s->VDegree(), s->NbUPoles(), s->NbVPoles(), (int64_t)loops.size()});
    send_knots(s->UKnots(), s->UMultiplicities());
    send_knots(s->VKnots(), s->VMultiplicities());
    std::vector<double> points, weights;
    for (int i = 1; i <= s->NbUPoles(); i++)
        for (int j = 1; j <= s->NbVPoles(); j++) {
            add_point(points, s->Pole(i, j));
            if (rational) weights.push_back(s->Weight(i, j));
        }
    send_doubles(points);
    send_doubles(weights);
    for (const Loop &loop : loops) {
        send_integers({(int64_t)loop.size() / 2});
        send_doubles(loop);
    }
}

void send_curve(const Handle(Geom_BSplineCurve) & c)
{
    send_integers({PIA_OCCT_SPLINE, 1, c->IsRational(), c->Degree(), 0, c->NbPoles(), 1, 0});
    send_knots(c->Knots(), c->Multiplicities());
    std::vector<double> points, weights;
    for (int i = 1; i <= c->NbPoles(); i++) {
        add_point(points, c->Pole(i));
        if (c->IsRational()) weights.push_back(c->Weight(i));
    }
    send_doubles(points);
    send_doubles(weights);
}

void send_error(const std::string &text)
{
    std::string padded = text.substr(0, 400);
    int64_t length = (int64_t)padded.size();
    padded.resize((padded.size() + 7) / 8 * 8, '\0');
    send_integers({PIA_OCCT_ERROR, length});
    send_bytes(padded.data(), padded.size());
}

void send_end()
{
    send_integers({PIA_OCCT_END});
}
