// OpenCASCADE's GeomAPI_PointsToBSplineSurface on one patch, cubic and C2.
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "patch.h"

static void print_surface(const Handle(Geom_BSplineSurface) & s, double seconds)
{
    printf("%.9g %d %d %d %d %d\n", seconds, s->UDegree(), s->VDegree(), s->NbUPoles(), s->NbVPoles(), s->NbUPoles() * s->NbVPoles());
    for (int k = 1; k <= s->NbUKnots(); k++)
        for (int m = 0; m < s->UMultiplicity(k); m++) printf("%.17g\n", s->UKnot(k));
    for (int k = 1; k <= s->NbVKnots(); k++)
        for (int m = 0; m < s->VMultiplicity(k); m++) printf("%.17g\n", s->VKnot(k));
    for (int i = 1; i <= s->NbUPoles(); i++)
        for (int j = 1; j <= s->NbVPoles(); j++) printf("%.17g %.17g %.17g\n", s->Pole(i, j).X(), s->Pole(i, j).Y(), s->Pole(i, j).Z());
}

int main(int argc, char **argv)
{
    if (argc != 2) return 2;
    patch_case c = patch_read(argv[1]);
    TColgp_Array2OfPnt points(1, c.rows, 1, c.columns);
    for (int i = 0; i < c.rows; i++)
        for (int j = 0; j < c.columns; j++) {
            const double *q = c.points + 3 * (i * c.columns + j);
            points.SetValue(i + 1, j + 1, gp_Pnt(q[0], q[1], q[2]));
        }
    try {
        double start = patch_now();
        GeomAPI_PointsToBSplineSurface fit(points, 3, 3, GeomAbs_C2, c.tolerance);
        double seconds = patch_now() - start;
        if (!fit.IsDone()) return 1;
        print_surface(fit.Surface(), seconds);
    } catch (const Standard_Failure &) {
        return 1;
    }
    free(c.points);
    return 0;
}
