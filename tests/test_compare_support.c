/* Thread pool, files written whole, tables. */
#include <check.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "common/output.h"
#include "compare/pool.h"
#include "compare/table.h"

enum { JOBS = 100 };

typedef struct {
    int done[JOBS];
    size_t fails_from; /* jobs with this index and above fail */
} work;

static const cmp_listener NOBODY = {NULL, NULL};

static cv_status job(void *context, size_t index, cv_message *why)
{
    work *w = context;
    w->done[index]++;
    return index >= w->fails_from ? cv_fail(why, CV_FAILED, "job %zu", index) : CV_OK;
}

START_TEST(every_job_is_done_once)
{
    for (size_t threads = 0; threads <= 8; threads++) {
        work w = {.fails_from = JOBS};
        cv_message why = {""};
        ck_assert_int_eq(cmp_pool_run(threads, JOBS, job, &w, &NOBODY, &why), CV_OK);
        for (int i = 0; i < JOBS; i++)
            ck_assert_int_eq(w.done[i], 1);
    }
}
END_TEST

START_TEST(the_failure_reported_does_not_depend_on_the_threads)
{
    for (size_t threads = 1; threads <= 8; threads++) {
        work w = {.fails_from = 37};
        cv_message why = {""};
        ck_assert_int_eq(cmp_pool_run(threads, JOBS, job, &w, &NOBODY, &why), CV_FAILED);
        ck_assert_str_eq(why.text, "job 37");
    }
}
END_TEST

static cv_status late_job(void *context, size_t index, cv_message *why)
{
    const struct timespec a_while = {0, 200000000};
    const size_t *late = context;
    if (index == *late)
        nanosleep(&a_while, NULL);
    return cv_fail(why, CV_FAILED, "job %zu", index);
}

START_TEST(the_lowest_failure_is_reported_whichever_comes_last)
{
    for (size_t late = 0; late < 3; late++) {
        cv_message why = {""};
        ck_assert_int_eq(cmp_pool_run(3, 3, late_job, &late, &NOBODY, &why), CV_FAILED);
        ck_assert_str_eq(why.text, "job 0");
    }
}
END_TEST

START_TEST(no_job_is_no_work)
{
    ck_assert_int_eq(cmp_pool_run(4, 0, job, NULL, &NOBODY, NULL), CV_OK);
}
END_TEST

static cv_status slow_job(void *context, size_t index, cv_message *why)
{
    const struct timespec while_told = {0, 700000000};
    (void)context, (void)index, (void)why;
    nanosleep(&while_told, NULL);
    return CV_OK;
}

static void tell(void *context, size_t done, size_t total, double seconds)
{
    *(int *)context += total == 2 && done <= 1 && seconds > 0.0;
}

START_TEST(progress_is_told)
{
    int told = 0;
    const cmp_listener listener = {tell, &told};
    ck_assert_int_eq(cmp_pool_run(1, 2, slow_job, NULL, &listener, NULL), CV_OK);
    ck_assert_int_ge(told, 1);
}
END_TEST

static char folder[] = "/tmp/critvel-test-XXXXXX";
static char path[64], again[64];

static void make_folder(void)
{
    strcpy(folder, "/tmp/critvel-test-XXXXXX");
    ck_assert_ptr_nonnull(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/report", folder);
    snprintf(again, sizeof again, "%s/link", folder);
}

static void remove_folder(void)
{
    unlink(path);
    unlink(again);
    ck_assert_int_eq(rmdir(folder), 0); /* fails where a temporary file was left behind */
}

static void expect_content(const char *where, const char *content)
{
    char text[64] = "";
    FILE *f = fopen(where, "r");
    ck_assert_ptr_nonnull(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    fclose(f);
    ck_assert_str_eq(text, content);
}

START_TEST(a_file_is_written_and_replaced)
{
    struct stat info;
    cv_message why = {""};
    ck_assert_int_eq(cv_output_check(path, &why), CV_OK);
    umask(022);
    ck_assert_int_eq(cv_output_write(path, "one", 3, &why), CV_OK);
    expect_content(path, "one");
    ck_assert_int_eq(stat(path, &info), 0);
    ck_assert_int_eq((int)(info.st_mode & 07777), 0644);
    ck_assert_int_eq(chmod(path, 0600), 0);
    ck_assert_int_eq(cv_output_write(path, "another", 7, &why), CV_OK);
    expect_content(path, "another");
    ck_assert_int_eq(stat(path, &info), 0);
    ck_assert_int_eq((int)(info.st_mode & 07777), 0600);
}
END_TEST

START_TEST(a_link_keeps_pointing)
{
    struct stat info;
    cv_message why = {""};
    ck_assert_int_eq(cv_output_write(path, "one", 3, &why), CV_OK);
    ck_assert_int_eq(symlink(path, again), 0);
    ck_assert_int_eq(cv_output_write(again, "two", 3, &why), CV_OK);
    ck_assert_int_eq(lstat(again, &info), 0);
    ck_assert(S_ISLNK(info.st_mode));
    expect_content(path, "two");
}
END_TEST

START_TEST(what_cannot_be_written_is_said_before_and_after)
{
    static const char *const bad[] = {"", "/tmp", "/tmp/", "/nonexistent/report", "/dev/null/report"};
    cv_message why;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ck_assert_msg(cv_output_check(bad[i], &why) == CV_FAILED, "%s", bad[i]);
        ck_assert_msg(strncmp(why.text, "cannot write ", 13) == 0, "%s", why.text);
        ck_assert_msg(cv_output_write(bad[i], "x", 1, &why) == CV_FAILED, "%s", bad[i]);
    }
}
END_TEST

/* In a process of its own: the limit cannot be raised again. */
static int write_beyond_limit(void)
{
    const struct rlimit small = {2, 2};
    cv_message why = {""};
    signal(SIGXFSZ, SIG_IGN);
    if (setrlimit(RLIMIT_FSIZE, &small) != 0)
        return -1;
    return (int)cv_output_write(path, "abcdef", 6, &why);
}

START_TEST(a_disk_that_fills_up_leaves_the_old_file)
{
    int status;
    cv_message why = {""};
    ck_assert_int_eq(cv_output_write(path, "ab", 2, &why), CV_OK);
    fflush(NULL);
    pid_t child = fork();
    if (child == 0)
        _exit(write_beyond_limit());
    ck_assert_int_eq(waitpid(child, &status, 0), child);
    ck_assert(WIFEXITED(status));
    ck_assert_int_eq(WEXITSTATUS(status), CV_FAILED);
    expect_content(path, "ab"); /* and remove_folder finds no temporary file */
}
END_TEST

START_TEST(devices_are_written_directly)
{
    struct stat info;
    cv_message why;
    ck_assert_int_eq(cv_output_check("/dev/full", &why), CV_OK);
    ck_assert_int_eq(cv_output_write("/dev/full", "x", 1, &why), CV_FAILED);
    ck_assert_ptr_nonnull(strstr(why.text, "/dev/full"));
    ck_assert_int_eq(cv_output_write("/dev/null", "x", 1, &why), CV_OK);
    ck_assert_int_eq(stat("/dev/null", &info), 0);
    ck_assert(S_ISCHR(info.st_mode));
}
END_TEST

START_TEST(tables_line_up)
{
    cmp_table t;
    char *text = NULL;
    size_t n = 0;
    FILE *memory = open_memstream(&text, &n);
    cmp_table_init(&t, "lrl");
    cmp_table_add(&t, (const char *const[]){"name", "n", "remark"});
    cmp_table_add(&t, (const char *const[]){"a", "100", ""});
    cmp_table_add(&t, (const char *const[]){"", "7", "x"});
    ck_assert_int_eq(cmp_table_print(&t, memory, 1, NULL), CV_OK);
    cmp_table_clear(&t);
    fclose(memory);
    ck_assert_str_eq(text, " name    n  remark\n"
                           " ----  ---  ------\n"
                           " a     100\n"
                           "         7  x\n");
    free(text);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("compare: support");
    TCase *t = tcase_create("pool and tables"), *f = tcase_create("files");
    tcase_add_test(t, every_job_is_done_once);
    tcase_add_test(t, the_failure_reported_does_not_depend_on_the_threads);
    tcase_add_test(t, the_lowest_failure_is_reported_whichever_comes_last);
    tcase_add_test(t, no_job_is_no_work);
    tcase_add_test(t, progress_is_told);
    tcase_add_test(t, tables_line_up);
    tcase_add_checked_fixture(f, make_folder, remove_folder);
    tcase_add_test(f, a_file_is_written_and_replaced);
    tcase_add_test(f, a_link_keeps_pointing);
    tcase_add_test(f, what_cannot_be_written_is_said_before_and_after);
    tcase_add_test(f, a_disk_that_fills_up_leaves_the_old_file);
    tcase_add_test(f, devices_are_written_directly);
    suite_add_tcase(s, t);
    suite_add_tcase(s, f);
    SRunner *r = srunner_create(s);
    srunner_run_all(r, CK_NORMAL);
    const int failed = srunner_ntests_failed(r);
    srunner_free(r);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
