#include "common/output.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static cv_status fail(const char *path, cv_message *why)
{
    return cv_fail(why, CV_FAILED, "cannot write %.300s: %s", path, strerror(errno));
}

/* The folder part of path, "." if there is none. */
static int folder_of(char out[PATH_MAX], const char *path)
{
    const char *slash = strrchr(path, '/');
    const size_t length = slash == NULL ? 0 : slash == path ? 1 : (size_t)(slash - path);
    if (length >= PATH_MAX) {
        errno = ENAMETOOLONG;
        return 0;
    }
    memcpy(out, length > 0 ? path : ".", length > 0 ? length : 1);
    out[length > 0 ? length : 1] = '\0';
    return 1;
}

cv_status cv_output_check(const char *path, cv_message *why)
{
    struct stat info;
    char folder[PATH_MAX];
    if (stat(path, &info) == 0) {
        if (S_ISDIR(info.st_mode)) {
            errno = EISDIR;
            return fail(path, why);
        }
        if (access(path, W_OK) != 0)
            return fail(path, why);
        if (!S_ISREG(info.st_mode))
            return CV_OK;
    } else if (errno != ENOENT || path[0] == '\0') {
        return fail(path, why);
    }
    return folder_of(folder, path) && access(folder, W_OK | X_OK) == 0 ? CV_OK : fail(path, why);
}

static int write_all(int fd, const char *bytes, size_t n)
{
    while (n > 0) {
        ssize_t written = write(fd, bytes, n);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return 0;
        bytes += written;
        n -= (size_t)written;
    }
    return 1;
}

static cv_status write_directly(const char *path, const char *bytes, size_t n, cv_message *why)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return fail(path, why);
    const int written = write_all(fd, bytes, n);
    const int error = errno;
    if (close(fd) == 0 && written)
        return CV_OK;
    if (!written)
        errno = error;
    return fail(path, why);
}

/* mkstemp makes files only the owner may read; a report gets the permissions any new file would, or those of
 * the file it replaces. */
static int set_mode(int fd, const char *target)
{
    struct stat info;
    if (stat(target, &info) == 0)
        return fchmod(fd, info.st_mode & 07777) == 0;
    const mode_t mask = umask(0);
    umask(mask);
    return fchmod(fd, 0666 & ~mask) == 0;
}

static cv_status write_and_rename(const char *target, const char *bytes, size_t n, cv_message *why)
{
    char temporary[PATH_MAX];
    if (strlen(target) + sizeof ".XXXXXX" > sizeof temporary) {
        errno = ENAMETOOLONG;
        return fail(target, why);
    }
    strcpy(temporary, target);
    strcat(temporary, ".XXXXXX");
    int fd = mkstemp(temporary);
    if (fd < 0)
        return fail(target, why);
    int good = write_all(fd, bytes, n) && set_mode(fd, target) && fsync(fd) == 0;
    int error = errno;
    if (close(fd) != 0 && good) {
        good = 0;
        error = errno;
    }
    if (good && rename(temporary, target) == 0)
        return CV_OK;
    if (!good)
        errno = error;
    cv_status status = fail(target, why);
    unlink(temporary);
    return status;
}

cv_status cv_output_write(const char *path, const char *bytes, size_t n, cv_message *why)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return errno == ENOENT ? write_and_rename(path, bytes, n, why) : fail(path, why);
    if (!S_ISREG(info.st_mode))
        return write_directly(path, bytes, n, why);
    char *resolved = realpath(path, NULL);
    if (resolved == NULL)
        return fail(path, why);
    cv_status status = write_and_rename(resolved, bytes, n, why);
    free(resolved);
    return status;
}
