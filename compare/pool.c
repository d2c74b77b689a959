#include "compare/pool.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include <mpfr.h>

typedef struct {
    pthread_mutex_t lock;
    pthread_cond_t finished; /* a thread ended */
    size_t count, next, done, running;
    size_t failed; /* index of the failed job with the lowest index; count: none */
    cv_status status;
    cv_message why;
    cmp_job *job;
    void *context;
} pool;

size_t cmp_processors(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 ? (size_t)n : 1;
}

/* The next job's index, or count when there is none to start. Jobs below a failed one still start: the
 * failure that is reported must not depend on which thread was faster. */
static size_t take(pool *p)
{
    pthread_mutex_lock(&p->lock);
    size_t index = p->next < p->failed ? p->next++ : p->count;
    pthread_mutex_unlock(&p->lock);
    return index;
}

static void give_back(pool *p, size_t index, cv_status status, const cv_message *why)
{
    pthread_mutex_lock(&p->lock);
    p->done++;
    if (status != CV_OK && index < p->failed) {
        p->failed = index;
        p->status = status;
        p->why = *why;
    }
    pthread_mutex_unlock(&p->lock);
}

static void *work(void *argument)
{
    pool *p = argument;
    for (size_t index = take(p); index < p->count; index = take(p)) {
        cv_message why = {""};
        cv_status status = p->job(p->context, index, &why);
        give_back(p, index, status, &why);
    }
    mpfr_free_cache();
    pthread_mutex_lock(&p->lock);
    p->running--;
    pthread_cond_signal(&p->finished);
    pthread_mutex_unlock(&p->lock);
    return NULL;
}

static double seconds_between(const struct timespec *from, const struct timespec *to)
{
    return (double)(to->tv_sec - from->tv_sec) + 1e-9 * (double)(to->tv_nsec - from->tv_nsec);
}

static void wait_and_tell(pool *p, const cmp_listener *listener)
{
    struct timespec start, now;
    clock_gettime(CLOCK_REALTIME, &start);
    pthread_mutex_lock(&p->lock);
    while (p->running > 0) {
        clock_gettime(CLOCK_REALTIME, &now);
        now.tv_nsec += 500000000;
        now.tv_sec += now.tv_nsec / 1000000000;
        now.tv_nsec %= 1000000000;
        if (pthread_cond_timedwait(&p->finished, &p->lock, &now) == ETIMEDOUT && listener->tell != NULL)
            listener->tell(listener->context, p->done, p->count, seconds_between(&start, &now));
    }
    pthread_mutex_unlock(&p->lock);
}

static cv_status start_and_join(pool *p, size_t threads, const cmp_listener *listener, cv_message *why)
{
    pthread_t *id = malloc(threads * sizeof *id);
    if (id == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    size_t started = 0;
    p->running = threads;
    while (started < threads && pthread_create(&id[started], NULL, work, p) == 0)
        started++;
    if (started < threads) {
        pthread_mutex_lock(&p->lock);
        p->running -= threads - started;
        pthread_mutex_unlock(&p->lock);
    }
    wait_and_tell(p, listener);
    for (size_t i = 0; i < started; i++)
        pthread_join(id[i], NULL);
    free(id);
    return started > 0 ? CV_OK : cv_fail(why, CV_FAILED, "no thread could be started");
}

cv_status cmp_pool_run(size_t threads, size_t count, cmp_job *job, void *context,
                       const cmp_listener *listener, cv_message *why)
{
    if (count == 0)
        return CV_OK;
    if (threads == 0)
        threads = cmp_processors();
    if (threads > count)
        threads = count;
    pool p = {.count = count, .failed = count, .job = job, .context = context};
    pthread_mutex_init(&p.lock, NULL);
    pthread_cond_init(&p.finished, NULL);
    cv_status status = start_and_join(&p, threads, listener, why);
    pthread_cond_destroy(&p.finished);
    pthread_mutex_destroy(&p.lock);
    if (status == CV_OK && p.failed < count)
        status = cv_fail(why, p.status, "%s", p.why.text);
    return status;
}

cv_status cmp_set_threads(void *to, const char *text, cv_message *why)
{
    char *end;
    const long n = strtol(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || n < 1 || n > 1024)
        return cv_fail(why, CV_BAD_INPUT, "\"%.60s\" is not a number of threads (1 to 1024)", text);
    *(size_t *)to = (size_t)n;
    return CV_OK;
}
