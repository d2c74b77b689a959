#include "compare/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static int is_program(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode) && access(path, X_OK) == 0;
}

cv_status cmp_gnuplot_find(char program[PATH_MAX], cv_message *why)
{
    const char *path = getenv("PATH");
    for (const char *entry = path != NULL ? path : ""; *entry != '\0';) {
        const size_t length = strcspn(entry, ":");
        char candidate[PATH_MAX];
        const int n = snprintf(candidate, sizeof candidate, "%.*s/gnuplot", length > 0 ? (int)length : 1,
                               length > 0 ? entry : ".");
        /* absolute, because it is run from another folder */
        if (n > 0 && n < PATH_MAX && is_program(candidate) && realpath(candidate, program) != NULL)
            return CV_OK;
        entry += length + (entry[length] == ':');
    }
    return cv_fail(why, CV_FAILED,
                   "gnuplot is not in PATH: the figures need it (Debian package gnuplot-nox)");
}

/* The environment with a locale in which numbers have a decimal point; the caller frees the array. */
static char **environment(void)
{
    static char locale[] = "LC_ALL=C.UTF-8";
    size_t count = 0, kept = 0;
    while (environ[count] != NULL)
        count++;
    char **copy = calloc(count + 2, sizeof *copy);
    if (copy == NULL)
        return NULL;
    for (size_t i = 0; i < count; i++)
        if (strncmp(environ[i], "LC_ALL=", 7) != 0)
            copy[kept++] = environ[i];
    copy[kept] = locale;
    return copy;
}

/* Between fork and exec only what is safe there: other threads may have held locks. */
static void become(const char *program, const char *folder, char *const arguments[], char *const variables[])
{
    if (chdir(folder) != 0)
        _exit(126);
    const int in = open("/dev/null", O_RDONLY);
    const int out = open("gnuplot.log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (in < 0 || out < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0)
        _exit(126);
    execve(program, arguments, variables);
    _exit(127);
}

/* The first line in which gnuplot says what is wrong, or else its first line. */
static void read_log(char *line, size_t size, const char *folder)
{
    char path[PATH_MAX], read[512];
    line[0] = '\0';
    const int n = snprintf(path, sizeof path, "%s/gnuplot.log", folder);
    FILE *log = n > 0 && n < PATH_MAX ? fopen(path, "r") : NULL;
    while (log != NULL && fgets(read, sizeof read, log) != NULL) {
        read[strcspn(read, "\r\n")] = '\0';
        const char *text = read + strspn(read, " \t^");
        const int names_line = strstr(text, "line ") != NULL && strstr(text, "warning") == NULL;
        if (text[0] != '\0' && (line[0] == '\0' || names_line))
            snprintf(line, size, "%s", text);
        if (names_line)
            break;
    }
    if (log != NULL)
        fclose(log);
}

static cv_status judge(int wait_status, const char *folder, const char *script, cv_message *why)
{
    char said[300];
    if (WIFEXITED(wait_status) && WEXITSTATUS(wait_status) == 0)
        return CV_OK;
    if (WIFSIGNALED(wait_status))
        return cv_fail(why, CV_FAILED, "gnuplot was ended by signal %d while drawing %s",
                       WTERMSIG(wait_status), script);
    if (WEXITSTATUS(wait_status) >= 126)
        return cv_fail(why, CV_FAILED, "gnuplot could not be started");
    read_log(said, sizeof said, folder);
    return cv_fail(why, CV_FAILED, "gnuplot failed on %s: %s", script,
                   said[0] != '\0' ? said : "it did not say why");
}

cv_status cmp_gnuplot_run(const char *program, const char *folder, const char *script, const char *format,
                          cv_message *why)
{
    char name[] = "gnuplot", defaults[] = "-d", execute[] = "-e", setting[64], file[PATH_MAX];
    char *const arguments[] = {name, defaults, execute, setting, file, NULL};
    int wait_status;
    snprintf(setting, sizeof setting, "format = '%s'", format);
    const int n = snprintf(file, sizeof file, "%s", script);
    char **variables = environment();
    if (variables == NULL || n >= PATH_MAX) {
        free(variables);
        return cv_fail(why, CV_FAILED, "out of memory");
    }
    const pid_t child = fork();
    if (child == 0)
        become(program, folder, arguments, variables);
    const int error = errno;
    free(variables);
    if (child < 0)
        return cv_fail(why, CV_FAILED, "gnuplot could not be started: %s", strerror(error));
    while (waitpid(child, &wait_status, 0) < 0)
        if (errno != EINTR)
            return cv_fail(why, CV_FAILED, "waiting for gnuplot: %s", strerror(errno));
    return judge(wait_status, folder, script, why);
}
