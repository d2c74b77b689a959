/* Arcs: the stretches of p between two roots of omega_k'', clipped to alpha_min .. alpha_max. */
#include <math.h>
#include <stdlib.h>

#include "semianalytic/branch_special.h"

static cv_status push_arc(sa_branch_curves *curves, const sa_branch_arc *arc)
{
    sa_branch_arc *larger = realloc(curves->arc, (curves->arc_count + 1) * sizeof *larger);

    if (!larger) {
        return CV_FAILED;
    }
    curves->arc = larger;
    larger[curves->arc_count++] = *arc;
    return CV_OK;
}

/* Moves the end of the newest arc to the given velocity. */
static cv_status clip(sa_branch_curves *curves, long double alpha, int is_high)
{
    sa_branch_arc *arc = &curves->arc[curves->arc_count - 1];
    long double q;
    sa_wave w;
    cv_status status = sa_branch_arc_at(&w, &q, curves, curves->arc_count - 1, alpha);

    *(is_high ? &arc->alpha_high : &arc->alpha_low) = alpha;
    *(is_high ? &arc->p_high : &arc->p_low) = w.p;
    return status;
}

/* Omega' runs from va at pa to vb at pb; adds the part with direction * omega' in the velocity range. */
static cv_status add_piece(sa_branch_curves *curves, int k, int direction, const long double p[2],
                           const long double v[2])
{
    int up = direction * v[1] > direction * v[0];
    sa_branch_arc arc = {.k = k,
                         .direction = direction,
                         .alpha_low = direction * v[!up],
                         .alpha_high = direction * v[up],
                         .p_low = p[!up],
                         .p_high = p[up]};

    if (!(arc.alpha_low < curves->alpha_max && arc.alpha_high > curves->alpha_min)) {
        return CV_OK;
    }
    cv_status status = push_arc(curves, &arc);
    if (status == CV_OK && arc.alpha_low < curves->alpha_min) {
        status = clip(curves, curves->alpha_min, 0);
    }
    if (status == CV_OK && arc.alpha_high > curves->alpha_max) {
        status = clip(curves, curves->alpha_max, 1);
    }
    return status;
}

static cv_status add_branch(sa_branch_curves *curves, int k)
{
    const sa_branch_node *last = &curves->grid.node[curves->grid.count - 1];
    sa_branch_function second = {.kind = 1, .k = k, .l = k, .sign = 1};
    long double *cusp;
    size_t count;
    cv_status status = sa_branch_grid_roots(&cusp, &count, &curves->grid, &second);
    long double p[2] = {0, 0}, v[2] = {0, 0};
    int has_tail = k == 1 && curves->grid.track.eta_s > 0;

    for (size_t i = 0; i <= count && status == CV_OK; i++) {
        sa_wave w = last->wave[k];
        if (i < count) {
            status = sa_dispersion_wave(&w, &curves->grid.track, k, cusp[i], 0);
        } else if (has_tail) {
            w.p = INFINITY;
            w.d[1] = sa_dispersion_shear_speed(&curves->grid.track);
        }
        p[1] = w.p;
        v[1] = w.d[1];
        for (int direction = 1; direction >= -1 && status == CV_OK; direction -= 2) {
            status = add_piece(curves, k, direction, p, v);
        }
        p[0] = p[1];
        v[0] = v[1];
    }
    free(cusp);
    return status;
}

cv_status sa_branch_arcs_find(sa_branch_curves *curves)
{
    cv_status status = CV_OK;

    for (int k = 0; k < SA_BRANCHES && status == CV_OK; k++) {
        status = add_branch(curves, k);
    }
    return status;
}
