/* Random numbers for tests: the seed is printed, and CRITVEL_SEED repeats a run. */
#ifndef CRITVEL_TESTS_SEED_H
#define CRITVEL_TESTS_SEED_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct {
    uint64_t state;
} seed_random;

static inline seed_random seed_start(const char *test)
{
    const char *text = getenv("CRITVEL_SEED");
    const uint64_t seed = text != NULL ? strtoull(text, NULL, 10) : (uint64_t)time(NULL);
    printf("%s: CRITVEL_SEED=%llu\n", test, (unsigned long long)seed);
    fflush(stdout);
    return (seed_random){seed};
}

/* splitmix64 (Steele, Lea, Flood 2014) */
static inline uint64_t seed_next(seed_random *r)
{
    uint64_t z = r->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* 0 .. n - 1 */
static inline unsigned seed_below(seed_random *r, unsigned n)
{
    return (unsigned)(seed_next(r) % n);
}

#endif
