#include "compare/lines.h"

#include <math.h>
#include <stdlib.h>

void cmp_line_point_init(cmp_line_point *p)
{
    mpfr_inits2(64, p->alpha, p->q, p->eta_M, (mpfr_ptr)0);
    p->alpha_error = p->q_error = p->eta_M_error = (double)NAN;
    p->turns = 0;
    p->decided = CV_OK;
}

void cmp_line_point_clear(cmp_line_point *p)
{
    mpfr_clears(p->alpha, p->q, p->eta_M, (mpfr_ptr)0);
}

void cmp_branches_init(cmp_branches *b)
{
    *b = (cmp_branches){.status = CV_OK};
}

static void branch_clear(cmp_branch *b)
{
    for (size_t i = 0; i < b->count; i++)
        cmp_line_point_clear(&b->vertices[i]);
    free(b->vertices);
}

void cmp_branches_clear(cmp_branches *b)
{
    for (size_t i = 0; i < b->count; i++)
        branch_clear(&b->branches[i]);
    free(b->branches);
    cmp_branches_init(b);
}

/* Room for one more in an array that grows at powers of two; NULL when out of memory, the old one then
 * stands. */
static void *room(void *items, size_t count, size_t size)
{
    if (count > 0 && (count & (count - 1)) != 0)
        return items;
    return realloc(items, (count > 0 ? 2 * count : 1) * size);
}

cmp_branch *cmp_branches_append(cmp_branches *b)
{
    cmp_branch *items = room(b->branches, b->count, sizeof *items);
    if (items == NULL)
        return NULL;
    const cmp_line_end open = {CMP_END_UNDECIDED, (double)NAN, (double)NAN, 0, 0, 0};
    b->branches = items;
    items[b->count] = (cmp_branch){.ends = {open, open}, .least_mass = NAN, .least_mass_error = NAN};
    return &items[b->count++];
}

cmp_line_point *cmp_branch_append(cmp_branch *b)
{
    cmp_line_point *items = room(b->vertices, b->count, sizeof *items);
    if (items == NULL)
        return NULL;
    b->vertices = items;
    cmp_line_point_init(&items[b->count]);
    return &items[b->count++];
}
