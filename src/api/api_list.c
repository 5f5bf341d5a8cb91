/* The registries of the build, seen from outside. */
#include "cloud.h"
#include "io.h"
#include "kernel.h"
#include "limit.h"
#include "method.h"
#include "param.h"
#include "place.h"
#include "plugin.h"

#include <string.h>

static int fill(pia_entry *out, const char *name, const char *title, const char *reference, const char *detail)
{
    *out = (pia_entry){name, title, reference, detail};
    return 1;
}

static int list_methods(pia_index index, pia_entry *out)
{
    if (index == 0)
        return fill(out, "auto", "the library takes whatever reaches the limit soonest and says what it took", NULL,
                    "interpolation, least squares, constraints, tolerance");
    const pia_method *m = pia_method_list(index - 1);
    return m != NULL && fill(out, m->name, m->title, m->reference, m->detail);
}

static int list_limiters(pia_index index, pia_entry *out)
{
    if (index == 0) return fill(out, "none", "steps are taken whole", NULL, NULL);
    const pia_limiter *l = pia_limit_list(index - 1);
    return l != NULL && fill(out, l->name, l->title, l->reference, l->detail);
}

/* A format as this installation can handle it. */
static int list_formats(pia_index index, pia_entry *out)
{
    const pia_format *f = pia_format_list(index);
    if (f == NULL) return 0;
    const char *detail = f->detail;
    if (f->plugin != NULL && !pia_plugin_is_there(f->plugin))
        detail = f->write_models != NULL ? "writes curves, surfaces and trimmed faces, exact to the bit; reading needs an optional part"
                                         : "reading needs an optional part, see `pia list parts`";
    return fill(out, f->name, f->title, f->reference, detail);
}

/* Optional parts, and whether this build has them. */
static int list_parts(pia_index index, pia_entry *out)
{
    const struct {
        const char *name, *title;
        int here;
    } part[] = {
        {"cairo", "pictures as SVG, PNG and PDF", PIA_HAVE_CAIRO},
        {"cholmod", "sparse Cholesky for scattered surfaces", PIA_HAVE_CHOLMOD},
        {"occt", "STEP, IGES and BREP read by OpenCASCADE, a plug-in", pia_plugin_is_there(&pia_plugin_occt)},
        {"hdf5", "arrays of HDF5 files, a plug-in", pia_plugin_is_there(&pia_plugin_hdf5)},
    };
    if (index >= (pia_index)(sizeof part / sizeof *part)) return 0;
    return fill(out, part[index].name, part[index].title, NULL, part[index].here ? "in this build" : "not in this build");
}

int pia_list(const char *registry, pia_index index, pia_entry *out)
{
    if (registry == NULL || out == NULL || index < 0) return 0;
    if (strcmp(registry, "method") == 0) return list_methods(index, out);
    if (strcmp(registry, "part") == 0) return list_parts(index, out);
    if (strcmp(registry, "limiter") == 0) return list_limiters(index, out);
    if (strcmp(registry, "parametrization") == 0) {
        pia_index ordered = 0;
        while (pia_param_list(ordered) != NULL) ordered++;
        const pia_parametrization *p = pia_param_list(index);
        const pia_cloud *c = pia_cloud_list(index - ordered);
        if (p != NULL) return fill(out, p->name, p->title, p->reference, p->detail);
        return c != NULL && fill(out, c->name, c->title, c->reference, c->detail);
    }
    if (strcmp(registry, "placement") == 0) {
        const pia_placement *p = pia_place_list(index);
        return p != NULL && fill(out, p->name, p->title, p->reference, p->detail);
    }
    if (strcmp(registry, "format") == 0) return list_formats(index, out);
    if (strcmp(registry, "backend") == 0) {
        const pia_kernel *k = pia_kernel_list(index);
        return k != NULL && fill(out, k->name, k->title, NULL, NULL);
    }
    return 0;
}

int pia_list_parameters(const char *name, pia_index index, pia_parameter *out)
{
    const pia_method *method = name != NULL ? pia_method_find(name) : NULL;
    const pia_limiter *limiter = name != NULL && method == NULL ? pia_limit_find(name) : NULL;
    const pia_parameter *parameters = method != NULL ? method->parameters : limiter != NULL ? limiter->parameters : NULL;
    if (parameters == NULL || out == NULL || index < 0) return 0;
    for (pia_index i = 0; parameters[i].name != NULL; i++)
        if (i == index) {
            *out = parameters[i];
            return 1;
        }
    return 0;
}
