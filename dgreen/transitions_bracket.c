#include "dgreen/transitions_bracket.h"

#define RND MPFR_RNDN

enum { MAX_ROUNDS = 400 };

static void end_init(dg_end *e, mpfr_prec_t precision)
{
    mpfr_inits2(precision, e->at, e->value, e->aside, e->aside_low, e->aside_high, (mpfr_ptr)NULL);
    e->sign = 0;
}

static void end_clear(dg_end *e)
{
    mpfr_clears(e->at, e->value, e->aside, e->aside_low, e->aside_high, (mpfr_ptr)NULL);
}

void dg_bracket_init(dg_bracket *b, mpfr_prec_t precision, dg_certified *function, void *context)
{
    end_init(&b->low, precision);
    end_init(&b->high, precision);
    end_init(&b->trial, precision);
    mpfr_inits2(precision, b->tolerance, b->width, b->step, (mpfr_ptr)NULL);
    b->scale = 1;
    b->function = function;
    b->context = context;
}

void dg_bracket_clear(dg_bracket *b)
{
    end_clear(&b->low);
    end_clear(&b->high);
    end_clear(&b->trial);
    mpfr_clears(b->tolerance, b->width, b->step, (mpfr_ptr)NULL);
}

cv_status dg_bracket_open(dg_bracket *b, mpfr_srcptr centre, double half, double most)
{
    for (; half <= most; half *= 4) {
        mpfr_sub_d(b->low.at, centre, half, RND);
        mpfr_add_d(b->high.at, centre, half, RND);
        cv_status status = b->function(&b->low, b->context);
        if (status == CV_OK)
            status = b->function(&b->high, b->context);
        if (status != CV_OK || b->low.sign != b->high.sign)
            return status;
    }
    return CV_UNDECIDED;
}

static void end_swap(dg_end *a, dg_end *b)
{
    const dg_end kept = *a;
    *a = *b;
    *b = kept;
}

/* Evaluates at b->trial.at, when that is inside, and moves one end there. */
static cv_status move_end(dg_bracket *b)
{
    if (mpfr_cmp(b->trial.at, b->low.at) <= 0 || mpfr_cmp(b->trial.at, b->high.at) >= 0)
        return CV_OK;
    const cv_status status = b->function(&b->trial, b->context);
    if (status == CV_OK)
        end_swap(&b->trial, b->trial.sign == b->low.sign ? &b->low : &b->high);
    return status;
}

/* b->step = max(tolerance/4, width^2/scale), at most width/4; b->trial.at = zero of the secant - step */
static void aim(dg_bracket *b)
{
    mpfr_sqr(b->step, b->width, RND);
    mpfr_div_d(b->step, b->step, b->scale, RND);
    mpfr_mul_2si(b->trial.value, b->tolerance, -2, RND);
    mpfr_max(b->step, b->step, b->trial.value, RND);
    mpfr_mul_2si(b->trial.value, b->width, -2, RND);
    mpfr_min(b->step, b->step, b->trial.value, RND);
    mpfr_sub(b->trial.value, b->high.value, b->low.value, RND);
    mpfr_div(b->trial.value, b->low.value, b->trial.value, RND);
    mpfr_mul(b->trial.value, b->trial.value, b->width, RND);
    mpfr_sub(b->trial.at, b->low.at, b->trial.value, RND);
    mpfr_sub(b->trial.at, b->trial.at, b->step, RND);
}

cv_status dg_bracket_close(dg_bracket *b)
{
    mpfr_t target;
    cv_status status = CV_OK;
    int round = 0;
    mpfr_init2(target, mpfr_get_prec(b->width));
    for (; round < MAX_ROUNDS && status == CV_OK; round++) {
        mpfr_sub(b->width, b->high.at, b->low.at, RND);
        if (mpfr_lessequal_p(b->width, b->tolerance))
            break;
        mpfr_div_2ui(target, b->width, 1, RND);
        aim(b);
        mpfr_t other; /* the far side of the secant's zero */
        mpfr_init2(other, mpfr_get_prec(b->step));
        mpfr_mul_2ui(other, b->step, 1, RND);
        mpfr_add(other, other, b->trial.at, RND);
        status = move_end(b);
        mpfr_set(b->trial.at, other, RND);
        mpfr_clear(other);
        if (status == CV_OK)
            status = move_end(b);
        mpfr_sub(b->width, b->high.at, b->low.at, RND);
        if (status == CV_OK && mpfr_greater_p(b->width, target)) {
            mpfr_add(b->trial.at, b->low.at, b->high.at, RND);
            mpfr_div_2ui(b->trial.at, b->trial.at, 1, RND);
            status = move_end(b);
        }
    }
    mpfr_clear(target);
    return status == CV_OK && round == MAX_ROUNDS ? CV_UNDECIDED : status;
}
