#include "dgreen/residues.h"

#include <float.h>
#include <math.h>

#include "dgreen/bounds.h"
#include "dgreen/lanes.h"

static const double UNIT = DBL_EPSILON / 2;

static inline double modulus(double re, double im)
{
    return sqrt(re * re + im * im);
}

/* R and R' at all near approximations; reach: bounds of |y*|, size: size polynomials there. Rounding errors
 * of the parts of R (units) as they are at flat roots. */
typedef struct {
    dg_lanes re, im, slope_re, slope_im, reach, size, rounding_re, rounding_im;
} samples;

DG_PART void sample_r(samples *s, const dg_operator *op, const dg_ring *y, const dg_discs *d)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        s->re.of[i] = s->im.of[i] = s->slope_re.of[i] = s->slope_im.of[i] = s->size.of[i] = 0;
        s->reach.of[i] = modulus(y->re[i], y->im[i]) + d->radius[i] * UNIT;
    }
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const double c_re = op->r_re[k], c_im = op->r_im[k], c_size = op->r_size[k];
        for (int i = 0; i < DG_DEGREE; i++) {
            const double slope = s->slope_re.of[i] * y->re[i] - s->slope_im.of[i] * y->im[i] + s->re.of[i];
            s->slope_im.of[i] = s->slope_re.of[i] * y->im[i] + s->slope_im.of[i] * y->re[i] + s->im.of[i];
            s->slope_re.of[i] = slope;
            const double value = s->re.of[i] * y->re[i] - s->im.of[i] * y->im[i] + c_re;
            s->im.of[i] = s->re.of[i] * y->im[i] + s->im.of[i] * y->re[i] + c_im;
            s->re.of[i] = value;
            s->size.of[i] = s->size.of[i] * s->reach.of[i] + c_size;
        }
    }
}

DG_PART void sample_rounding(samples *s, const dg_operator *op, const dg_ring *y)
{
    dg_lanes re = {{0}}, im = {{0}};
    for (int k = DG_R_DEGREE; k >= 0; k--) {
        const double c_re = op->r_size_re[k], c_im = op->r_size_im[k];
        for (int i = 0; i < DG_DEGREE; i++) {
            const double across = fabs(y->re[i]), up = fabs(y->im[i]);
            const double next = re.of[i] * across + im.of[i] * up + c_re;
            im.of[i] = re.of[i] * up + im.of[i] * across + c_im;
            re.of[i] = next;
        }
    }
    for (int i = 0; i < DG_DEGREE; i++) {
        s->rounding_re.of[i] = DG_R_UNITS * re.of[i];
        s->rounding_im.of[i] = DG_R_UNITS * im.of[i];
    }
}

/* Residues R/Delta' of the near roots with the bounds of their parts (units) */
typedef struct {
    dg_lanes re, im, error_re, error_im;
} residues;

/* Each with one bound for both parts */
DG_PART void plain_residues(residues *out, const samples *s, const dg_discs *d)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        const double d_re = d->d_re[i], d_im = d->d_im[i], norm = d_re * d_re + d_im * d_im;
        const double slope = modulus(s->slope_re.of[i], s->slope_im.of[i]);
        const double top_error = dg_numerator_error(s->size.of[i], slope, s->reach.of[i], d->radius[i], UNIT);
        const double error =
            dg_quotient_error(modulus(s->re.of[i], s->im.of[i]), top_error, sqrt(norm), d->d_error[i], UNIT);
        out->re.of[i] = (s->re.of[i] * d_re + s->im.of[i] * d_im) / norm;
        out->im.of[i] = (s->im.of[i] * d_re - s->re.of[i] * d_im) / norm;
        out->error_re.of[i] = out->error_im.of[i] = error;
    }
}

/* A complex number, or the bounds of the errors of its parts */
typedef struct {
    double re, im;
} pair;

DG_PART pair times(pair a, pair b)
{
    return (pair){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

/* error += what errors of the parts of one factor do to the parts of a product */
DG_PART void spread(pair *error, pair parts, pair factor)
{
    error->re += parts.re * fabs(factor.re) + parts.im * fabs(factor.im);
    error->im += parts.re * fabs(factor.im) + parts.im * fabs(factor.re);
}

/* Everything that can be wrong with f', R, E and d of a flat residue r, relative to itself, times itself
 * (units) */
DG_PART double second_order(const dg_discs *d, int i, const samples *s, pair r)
{
    const double slope = modulus(d->d_re[i], d->d_im[i]), whole = modulus(r.re, r.im);
    const double radius = d->radius[i], absolute = radius * UNIT, crowding = d->crowding[i];
    const double reach = s->reach.of[i];
    const double relative =
        (d->d_error[i] + 16) * UNIT + d->field_error[i] / crowding + 3 * absolute * crowding;
    const double movement =
        radius * (2 * crowding * whole + modulus(s->slope_re.of[i], s->slope_im.of[i]) / slope);
    const double rounding =
        (s->rounding_re.of[i] + s->rounding_im.of[i] + (d->rounding_re[i] + d->rounding_im[i]) * whole) /
        slope;
    const double curvature =
        s->size.of[i] * absolute / (reach * slope) * (6 * radius / reach + 8 * DG_R_UNITS);
    const double product = absolute * crowding * radius * crowding * whole;
    return 3 * (movement + rounding) * relative + 2 * curvature + 2.5 * product;
}

/* Flat roots, parts apart. With d = y - y*, E = sum of 1/(y - y_k*), x = |d| crowding <= 0.05:
 *     R(y*)      = R - R' d + e,                        |e| <= 6 size/reach^2 |d|^2
 *     1/f'(y*)   = (1/f') (1 + 2 d E + e'),             |e'| <= 2.5 x^2          (products of differences)
 * hence the residue is r + d (2 E r - R'/f') + rounding + terms of second order in d and the rounding. */
DG_PART void flat_residues(residues *out, const samples *s, const dg_discs *d)
{
    for (int i = 0; i < DG_DEGREE; i++) {
        const double norm = d->d_re[i] * d->d_re[i] + d->d_im[i] * d->d_im[i];
        const pair inverse = {d->d_re[i] / norm, -d->d_im[i] / norm}; /* 1/f' */
        const pair r = times((pair){s->re.of[i], s->im.of[i]}, inverse);
        const pair field = times((pair){2 * d->field_re[i], 2 * d->field_im[i]}, r);
        const pair slope = times((pair){s->slope_re.of[i], s->slope_im.of[i]}, inverse);
        pair error = {0, 0};
        spread(&error, (pair){d->radius[i], d->radius_im[i]},
               (pair){field.re - slope.re, field.im - slope.im});
        spread(&error, (pair){s->rounding_re.of[i], s->rounding_im.of[i]}, inverse);
        spread(&error, (pair){d->rounding_re[i], d->rounding_im[i]}, times(r, inverse));
        spread(&error, (pair){8 * fabs(s->re.of[i]), 8 * fabs(s->im.of[i])}, inverse);
        const double second = second_order(d, i, s, r);
        out->re.of[i] = r.re;
        out->im.of[i] = r.im;
        out->error_re.of[i] = error.re + second;
        out->error_im.of[i] = error.im + second;
    }
}

/* With u = 1/y the residue is -u^2 [u^4 R(i/u)]/[d/du u^8 Delta(i/u)]: of third order in u. */
static dg_residue far_residue(const dg_operator *op, const dg_roots *roots, const dg_discs *d, int i)
{
    const double complex u = CMPLX(roots->re[i], roots->im[i]), slope = CMPLX(d->d_re[i], d->d_im[i]);
    const double radius = d->radius[i], reach = cabs(u) + radius * UNIT;
    const dg_r_size s = dg_r_size_at(op, 1, creal(u), cimag(u), reach);
    double complex top = 0;
    for (int k = 0; k <= DG_R_DEGREE; k++)
        top = top * u + CMPLX(op->r_re[k], op->r_im[k]);
    const double top_error = dg_numerator_error(s.size, s.slope, reach, radius, UNIT);
    const double whole = cabs(top) + top_error * UNIT;
    const double error = reach * reach * (top_error + 8 * whole) + 2 * reach * radius * whole;
    const double complex residue = -u * u * top / slope;
    const double bound = dg_quotient_error(cabs(u * u * top), error, cabs(slope), d->d_error[i], UNIT);
    return (dg_residue){creal(residue), cimag(residue), bound, bound};
}

DG_PART void add(dg_residue *sum, dg_residue r)
{
    sum->re += r.re;
    sum->im += r.im;
    sum->error_re += r.error_re + 8 * fabs(r.re);
    sum->error_im += r.error_im + 8 * fabs(r.im);
}

static void add_doubtful(dg_residues *out, dg_residue r)
{
    const double size = modulus(r.re, r.im) / UNIT + r.error_re;
    out->right.error_re += size;
    out->right.error_im += size;
    out->left.error_re += size;
    out->left.error_im += size;
}

/* Re lambda = -Im y; Im(1/y) has the other sign. */
DG_PART int side(const dg_roots *roots, const dg_discs *discs, int i, int far)
{
    const double real_part = far ? roots->im[i] : -roots->im[i];
    if (!(fabs(real_part) > discs->radius_im[i] * UNIT))
        return 0;
    return real_part > 0 ? 1 : -1;
}

DG_PART int balanced(const dg_residues *s)
{
    return fabs(s->right.re + s->left.re) <= (s->right.error_re + s->left.error_re) * UNIT &&
           fabs(s->right.im + s->left.im) <= (s->right.error_im + s->left.error_im) * UNIT;
}

/* Adds what belongs to root i where it belongs. */
DG_PART cv_status distribute(dg_residues *out, dg_residue r, int to, int far)
{
    if (to == 0 && !far)
        return CV_UNDECIDED;
    if (to == 0) {
        add_doubtful(out, r);
        return CV_OK;
    }
    add(to > 0 ? &out->right : &out->left, r);
    out->right_count += to > 0;
    out->left_count += to < 0;
    return CV_OK;
}

DG_CLONES cv_status dg_residues_sum(dg_residues *out, const dg_operator *op, const dg_roots *roots,
                                    const dg_discs *discs)
{
    samples s;
    residues plain, flat;
    dg_ring y;
    cv_status status = CV_OK;
    dg_ring_set(&y, roots);
    sample_r(&s, op, &y, discs);
    sample_rounding(&s, op, &y);
    plain_residues(&plain, &s, discs);
    flat_residues(&flat, &s, discs);
    *out = (dg_residues){0};
    for (int i = 0; i < roots->count && status == CV_OK; i++) {
        const int far = roots->far && i == roots->count - 1;
        const residues *near = discs->flat[i] ? &flat : &plain;
        const dg_residue r =
            far ? far_residue(op, roots, discs, i)
                : (dg_residue){near->re.of[i], near->im.of[i], near->error_re.of[i], near->error_im.of[i]};
        status = distribute(out, r, side(roots, discs, i, far), far);
    }
    if (status != CV_OK)
        return status;
    return balanced(out) ? CV_OK : CV_FAILED;
}
