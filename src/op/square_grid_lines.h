/* Lines along v are solved many at a time, transposed in registers so that vectors run across them: block [v and its margins x dim x
 * lines of a block], zeros around it. Included once for each width, after square_grid_vectors.h, with JOIN(a, b) the vector of all
 * quarters, QUARTER(a, k) one of them, EVEN, ODD, LOW, HIGH the steps of a transposition within each, TARGETS before functions that are
 * made for certain processors. */
enum {
    QUARTERS = LANES / PIA_LANES,
    TILE = PIA_LANES /* points whose numbers are transposed together */
};

/* Four rows to columns and back, in every quarter. */
PIA_INLINE void transpose(lanes row[TILE])
{
    lanes even = EVEN(row[0], row[1]), odd = ODD(row[0], row[1]);
    lanes even_below = EVEN(row[2], row[3]), odd_below = ODD(row[2], row[3]);
    row[0] = LOW(even, even_below);
    row[1] = LOW(odd, odd_below);
    row[2] = HIGH(even, even_below);
    row[3] = HIGH(odd, odd_below);
}

/* Numbers from `at` on of TILE points of LANES lines, a vector across the lines each. */
PIA_INLINE void load_tile(const double *const *line, pia_index at, int dim, lanes *number)
{
    for (int part = 0; part < dim; part++) {
        lanes *four = number + part * TILE;
        const pia_index from = at + part * TILE;
        for (int l = 0; l < TILE; l++) four[l] = JOIN(pia_vector_load(line[l] + from), pia_vector_load(line[l + LANES - TILE] + from));
        transpose(four);
    }
}

/* Fewer points than TILE, or such that do not lie one after the other; and zeros after them. */
PIA_INLINE void load_some(const pia_square_grid *g, const double *const *line, pia_index point, int points, int dim, lanes *number)
{
    double copy[LANES][TILE * PIA_GRID_MOST_DIM] = {{0}};
    const double *from[LANES];
    for (int l = 0; l < LANES; l++) {
        for (int k = 0; k < points; k++)
            memcpy(copy[l] + k * dim, line[l] + pia_grid_turn(g->v, point + k) * dim, (size_t)dim * sizeof(double));
        from[l] = copy[l];
    }
    load_tile(from, 0, dim, number);
}

PIA_INLINE void store_tile(lanes *number, int dim, double *const *line, pia_index at)
{
    for (int part = 0; part < dim; part++) {
        lanes *four = number + part * TILE;
        transpose(four);
        for (int k = 0; k < QUARTERS; k++)
            for (int l = 0; l < TILE; l++) {
                pia_lanes some = QUARTER(four[l], k);
                memcpy(line[k * TILE + l] + at + part * TILE, &some, sizeof some);
            }
    }
}

/* Points point .. point + points - 1 of LANES lines, at `block` of point 0: forward substitution. What is looked up is read before the
 * first number is written, which could be anywhere as far as the compiler knows. */
PIA_INLINE void go_down(const pia_square_grid *g, const lanes *number, pia_index point, int points, int reach, int dim, double *block)
{
    const pia_grid_side *v = g->v;
    const pia_index row = pia_grid_lines(dim), size = v->lower + 1 + v->upper;
    const double *factor = v->factor + point * size + v->lower;
    double shift[PIA_GRID_MOST_DIM], *at = block + point * dim * row;
    for (int d = 0; d < dim; d++) shift[d] = g->shift[g->halo + d];
    for (int k = 0; k < points; k++, factor += size)
        for (int d = 0; d < dim; d++, at += row) {
            lanes y = number[k * dim + d] - shift[d];
            for (int r = reach; r >= 1; r--) y -= factor[-r] * lanes_load(at - r * dim * row);
            lanes_store(y * factor[0], at);
        }
}

/* The same back. */
PIA_INLINE void go_up(const pia_square_grid *g, lanes *number, pia_index point, int points, int reach, int dim, double *block)
{
    const pia_grid_side *v = g->v;
    const pia_index row = pia_grid_lines(dim), size = v->lower + 1 + v->upper;
    const double *factor = v->factor + (point + points - 1) * size + v->lower;
    for (int k = points - 1; k >= 0; k--, factor -= size)
        for (int d = 0; d < dim; d++) {
            double *at = block + ((point + k) * dim + d) * row;
            lanes x = lanes_load(at);
            for (int r = reach; r >= 1; r--) x -= factor[r] * lanes_load(at + r * dim * row);
            lanes_store(x, at);
            number[k * dim + d] = x;
        }
}

PIA_INLINE void tile_down(const pia_square_grid *g, const double *const *line, pia_index point, int narrow, int dim, double *block)
{
    lanes number[TILE * PIA_GRID_MOST_DIM];
    pia_index left = g->v->n + g->v->margin - point;
    if (point >= 0 && point + TILE <= g->v->n)
        load_tile(line, point * dim, dim, number);
    else
        load_some(g, line, point, left < TILE ? (int)left : TILE, dim, number);
    if (left < TILE)
        go_down(g, number, point, (int)left, g->v->lower, dim, block);
    else if (narrow)
        go_down(g, number, point, TILE, 1, dim, block);
    else
        go_down(g, number, point, TILE, g->v->lower, dim, block);
}

/* Lines have room for whole units. */
PIA_INLINE void tile_up(const pia_square_grid *g, double *const *line, pia_index point, int narrow, int dim, double *block)
{
    lanes number[TILE * PIA_GRID_MOST_DIM];
    pia_index left = g->v->n + g->v->margin - point;
    for (int k = left < TILE ? (int)left * dim : TILE * dim; k < TILE * dim; k++) number[k] = (lanes){0};
    if (left < TILE)
        go_up(g, number, point, (int)left, g->v->upper, dim, block);
    else if (narrow)
        go_up(g, number, point, TILE, 1, dim, block);
    else
        go_up(g, number, point, TILE, g->v->upper, dim, block);
    if (point >= 0 && point < g->v->n) store_tile(number, dim, line, point * dim);
}

/* Lines past the last one are the last one again. */
PIA_INLINE void solve_lines(const pia_square_grid *g, pia_index first, int dim, double *room)
{
    const pia_grid_side *v = g->v;
    const pia_index count = pia_grid_lines(dim), row = dim * count;
    const pia_index margin = v->margin, last = v->n + margin;
    double *block = room + (v->lower + margin) * row, *to[PIA_GRID_MOST_LINES];
    const double *from[PIA_GRID_MOST_LINES];
    for (pia_index l = 0; l < count; l++) {
        pia_index line = first + l < g->u->n ? first + l : g->u->n - 1;
        from[l] = g->points + line * v->n * dim;
        to[l] = g->along + line * g->stride;
    }
    memset(room, 0, (size_t)(v->lower * row) * sizeof *room);
    memset(block + last * row, 0, (size_t)(v->upper * row) * sizeof *block);
    for (pia_index unit = -margin; unit < last; unit += UNIT) {
        pia_index end = unit + UNIT < last ? unit + UNIT : last;
        int narrow = all_narrow(v->narrow_factor, unit, end);
        for (pia_index q = 0; q < count && first + q < g->u->n; q += LANES)
            for (pia_index point = unit; point < end; point += TILE) tile_down(g, from + q, point, narrow, dim, block + q);
    }
    for (pia_index unit = (last - 1) / UNIT * UNIT; unit >= -margin; unit -= UNIT) {
        pia_index end = unit + UNIT < last ? unit + UNIT : last;
        int narrow = all_narrow(v->narrow_factor, unit, end);
        for (pia_index q = 0; q < count && first + q < g->u->n; q += LANES)
            for (pia_index point = unit + UNIT - TILE; point >= unit; point -= TILE)
                if (point < end) tile_up(g, to + q, point, narrow, dim, block + q);
    }
}

TARGETS static void lines(const pia_square_grid *g, pia_index first, double *room)
{
    switch (g->dim) {
    case 1: solve_lines(g, first, 1, room); break;
    case 2: solve_lines(g, first, 2, room); break;
    case 3: solve_lines(g, first, 3, room); break;
    default: solve_lines(g, first, g->dim, room); break;
    }
}
