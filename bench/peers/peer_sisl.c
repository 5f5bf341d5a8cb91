/* SISL's data reduction s1961 on one case. SISL is a program of its own here; nothing of it is linked into the library. */
#include <sisl.h>

#include "peer.h"

int main(int argc, char **argv)
{
    if (argc != 2) return 2;
    peer_case c = peer_read(argv[1]);
    double eps[16], error[16];
    for (int d = 0; d < c.dim; d++) eps[d] = c.tolerance;
    SISLCurve *curve = NULL;
    int status;
    double start = peer_now();
    s1961(c.points, c.rows, c.dim, 1, NULL, eps, 0, 0, 1, 0.0, 10, 4, &curve, error, &status);
    double seconds = peer_now() - start;
    if (status < 0 || curve == NULL) return 1;
    printf("%.9g %d %d %d\n", seconds, curve->ik - 1, curve->in, curve->in);
    for (int i = 0; i < curve->in + curve->ik; i++) printf("%.17g\n", curve->et[i]);
    for (int i = 0; i < curve->in * c.dim; i++) printf("%.17g\n", curve->ecoef[i]);
    freeCurve(curve);
    free(c.points);
    return 0;
}
