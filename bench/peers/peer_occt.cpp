// OpenCASCADE's GeomAPI_PointsToBSpline on one case, cubic and C2.
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array1OfPnt.hxx>

#include "peer.h"

static void print_curve(const peer_case &c, const Handle(Geom_BSplineCurve) & curve, double seconds)
{
    printf("%.9g %d %d %d\n", seconds, curve->Degree(), curve->NbPoles(), curve->NbPoles());
    for (int k = 1; k <= curve->NbKnots(); k++)
        for (int m = 0; m < curve->Multiplicity(k); m++) printf("%.17g\n", curve->Knot(k));
    for (int i = 1; i <= curve->NbPoles(); i++)
        for (int d = 0; d < c.dim; d++) printf("%.17g\n", curve->Pole(i).Coord(d + 1));
}

int main(int argc, char **argv)
{
    if (argc != 2) return 2;
    peer_case c = peer_read(argv[1]);
    TColgp_Array1OfPnt points(1, c.rows);
    for (int i = 0; i < c.rows; i++) {
        const double *q = c.points + i * c.dim;
        points.SetValue(i + 1, gp_Pnt(q[0], q[1], c.dim > 2 ? q[2] : 0));
    }
    try {
        double start = peer_now();
        GeomAPI_PointsToBSpline fit(points, 3, 3, GeomAbs_C2, c.tolerance);
        double seconds = peer_now() - start;
        if (!fit.IsDone()) return 1;
        print_curve(c, fit.Curve(), seconds);
    } catch (const Standard_Failure &) {
        return 1;
    }
    free(c.points);
    return 0;
}
