/* The parts of a report, from the scene to JSON and packed numbers: page.c orders them, page_model.c and page_points.c write them,
 * page_deviation.c finds what they show, web/ reads them. */
#ifndef PIA_REPORT_PAGE_H
#define PIA_REPORT_PAGE_H

#include "page_json.h"
#include "page_pack.h"
#include "scene.h"

typedef struct pia_page {
    pia_context *context;
    const pia_page_options *options;
    pia_scene scene;
    const pia_index *rows; /* [scene.point_count] names of the points; NULL: their indices */
    pia_json json;
    pia_pack pack;
    int components; /* of a position: 2 in the plane, 3 in space */
} pia_page;

/* A member that says where and how a lattice is packed; see pia_series_add. */
pia_status pia_page_lattice(pia_page *page, const char *key, pia_series *series, const double *values, pia_index stride, pia_index rows,
                            pia_index columns);

/* page_model.c: the members of one model with its frames, an object. */
pia_status pia_page_model(pia_page *page, pia_index model);

/* page_points.c: the points that are shown, an object; nothing without points. */
pia_status pia_page_points(pia_page *page);

/* page_deviation.c: gives the deviations of the scene a sign: above a surface, or left of a planar curve, is positive. Returns 1, or 0
 * where there are no sides. */
int pia_page_sides(const pia_scene *scene, double *deviation);
/* Percentiles and histogram of all deviations, as members; signed ones share their bins evenly about 0. */
pia_status pia_page_statistics(pia_page *page, const double *deviation, int has_sides);
/* The member "map": the largest deviation about each node of a lattice over the domain of a surface, NaN where no point is near. */
pia_status pia_page_map(pia_page *page, pia_index model, const double *deviation);

#endif
