#include "compare/picture.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/cli.h"
#include "common/output.h"
#include "compare/gnuplot.h"

cv_status cmp_picture_open(cmp_picture *p, const char *name, cv_message *why)
{
    *p = (cmp_picture){.data = NULL};
    snprintf(p->name, sizeof p->name, "%s", name);
    p->data = open_memstream(&p->data_bytes, &p->data_size);
    p->script = open_memstream(&p->script_bytes, &p->script_size);
    if (p->data != NULL && p->script != NULL)
        return CV_OK;
    cmp_picture_clear(p);
    return cv_fail(why, CV_FAILED, "out of memory");
}

static int close_stream(FILE **stream)
{
    const int good = *stream == NULL || !ferror(*stream);
    const int closed = *stream == NULL || fclose(*stream) == 0;
    *stream = NULL;
    return good && closed;
}

void cmp_picture_clear(cmp_picture *p)
{
    close_stream(&p->data);
    close_stream(&p->script);
    free(p->data_bytes);
    free(p->script_bytes);
    *p = (cmp_picture){.data = NULL};
}

void cmp_picture_doubt(cmp_picture *p, const char *text)
{
    if (p->doubt.text[0] == '\0')
        snprintf(p->doubt.text, sizeof p->doubt.text, "%s", text);
}

/* Like mkdir -p: a parent that is there already is as good as one made here. */
static cv_status make_folder(const char *path, cv_message *why)
{
    char part[PATH_MAX];
    struct stat info;
    if (path[0] == '\0' || strlen(path) >= sizeof part)
        return cv_fail(why, CV_FAILED, "cannot make the folder \"%.300s\": %s", path,
                       path[0] == '\0' ? "it has no name" : strerror(ENAMETOOLONG));
    strcpy(part, path);
    for (char *slash = part; slash != NULL;) {
        slash = strchr(slash + 1, '/');
        if (slash != NULL)
            *slash = '\0';
        if (mkdir(part, 0777) != 0 && errno != EEXIST && slash == NULL)
            return cv_fail(why, CV_FAILED, "cannot make the folder %.300s: %s", path, strerror(errno));
        if (slash != NULL)
            *slash = '/';
    }
    if (stat(path, &info) != 0 || !S_ISDIR(info.st_mode))
        return cv_fail(why, CV_FAILED, "cannot write to %.300s: %s", path, strerror(ENOTDIR));
    if (access(path, W_OK | X_OK) != 0)
        return cv_fail(why, CV_FAILED, "cannot write to %.300s: %s", path, strerror(errno));
    return CV_OK;
}

cv_status cmp_album_open(cmp_album *a, const char *path, int formats, cv_message *why)
{
    a->formats = formats;
    cv_status status = cmp_gnuplot_find(a->gnuplot, why);
    if (status == CV_OK)
        status = make_folder(path, why);
    if (status == CV_OK)
        strcpy(a->path, path);
    return status;
}

static cv_status file_path(char out[PATH_MAX], const char *folder, const char *name, const char *extension,
                           cv_message *why)
{
    const int n = snprintf(out, PATH_MAX, "%s/%s.%s", folder, name, extension);
    return n > 0 && n < PATH_MAX ? CV_OK
                                 : cv_fail(why, CV_FAILED, "cannot write %.200s/%.100s.%s: %s", folder, name,
                                           extension, strerror(ENAMETOOLONG));
}

static cv_status write_file(const char *folder, const char *name, const char *extension, const char *bytes,
                            size_t n, cv_message *why)
{
    char path[PATH_MAX];
    const cv_status status = file_path(path, folder, name, extension, why);
    return status == CV_OK ? cv_output_write(path, bytes, n, why) : status;
}

/* Caller frees *bytes. An empty file is a failure: gnuplot has not drawn anything. */
static cv_status read_file(char **bytes, size_t *n, const char *folder, const char *name,
                           const char *extension, cv_message *why)
{
    char path[PATH_MAX], block[65536];
    cv_status status = file_path(path, folder, name, extension, why);
    if (status != CV_OK)
        return status;
    FILE *in = fopen(path, "rb"), *memory = open_memstream(bytes, n);
    size_t got;
    while (in != NULL && memory != NULL && (got = fread(block, 1, sizeof block, in)) > 0)
        fwrite(block, 1, got, memory);
    const int good = in != NULL && memory != NULL && !ferror(in) && !ferror(memory);
    if (in != NULL)
        fclose(in);
    if ((memory != NULL && fclose(memory) != 0) || !good || *n == 0)
        return cv_fail(why, CV_FAILED, "gnuplot has not written %s.%s", name, extension);
    return CV_OK;
}

/* The date in the document information becomes blanks: as many bytes, so that all offsets in the file hold,
 * and the entry is optional. */
static void blank_date(char *bytes, size_t n)
{
    static const char key[] = "/CreationDate (";
    const size_t length = sizeof key - 1;
    for (size_t i = 0; i + length <= n; i++) {
        if (memcmp(bytes + i, key, length) != 0)
            continue;
        const char *end = memchr(bytes + i, ')', n - i);
        if (end != NULL)
            memset(bytes + i, ' ', (size_t)(end - (bytes + i)) + 1);
        return;
    }
}

static cv_status draw_format(const cmp_picture *p, const cmp_album *a, const char *folder, const char *format,
                             cv_message *why)
{
    char script[CMP_PICTURE_NAME + 4], *bytes = NULL;
    size_t n = 0;
    snprintf(script, sizeof script, "%s.gp", p->name);
    cv_status status = cmp_gnuplot_run(a->gnuplot, folder, script, format, why);
    if (status == CV_OK)
        status = read_file(&bytes, &n, folder, p->name, format, why);
    if (status == CV_OK) {
        if (strcmp(format, "pdf") == 0)
            blank_date(bytes, n);
        status = write_file(a->path, p->name, format, bytes, n, why);
    }
    free(bytes);
    return status;
}

static cv_status draw(const cmp_picture *p, const cmp_album *a, const char *folder, cv_message *why)
{
    cv_status status = write_file(folder, p->name, "dat", p->data_bytes, p->data_size, why);
    if (status == CV_OK)
        status = write_file(folder, p->name, "gp", p->script_bytes, p->script_size, why);
    if (status == CV_OK && (a->formats & CMP_SVG))
        status = draw_format(p, a, folder, "svg", why);
    if (status == CV_OK && (a->formats & CMP_PDF))
        status = draw_format(p, a, folder, "pdf", why);
    if (status == CV_OK)
        status = write_file(a->path, p->name, "dat", p->data_bytes, p->data_size, why);
    if (status == CV_OK)
        status = write_file(a->path, p->name, "gp", p->script_bytes, p->script_size, why);
    return status;
}

/* Removes a folder that holds files only. */
static void remove_folder(const char *path)
{
    DIR *folder = opendir(path);
    const struct dirent *entry;
    while (folder != NULL && (entry = readdir(folder)) != NULL)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder != NULL)
        closedir(folder);
    rmdir(path);
}

cv_status cmp_picture_publish(cmp_picture *p, const cmp_album *a, cv_message *why)
{
    char folder[PATH_MAX];
    const char *base = getenv("TMPDIR");
    const int written = close_stream(&p->data) & close_stream(&p->script);
    if (!written)
        return cv_fail(why, CV_FAILED, "out of memory");
    const int n =
        snprintf(folder, sizeof folder, "%s/critvel-XXXXXX", base != NULL && base[0] != '\0' ? base : "/tmp");
    if (n >= PATH_MAX || mkdtemp(folder) == NULL)
        return cv_fail(why, CV_FAILED, "cannot make a temporary folder %.300s: %s", folder, strerror(errno));
    const cv_status status = draw(p, a, folder, why);
    remove_folder(folder);
    return status;
}
