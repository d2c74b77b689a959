/* critvel-semianalytic lines: instability lines and their asymptotes. */
#include <stdlib.h>

#include "common/output.h"
#include "semianalytic/commands.h"
#include "semianalytic/lines_report.h"

static cv_status write_as(FILE *out, const sa_lines_report *report, const sa_options *options)
{
    if (options->csv)
        return sa_lines_write_csv(out, report);
    return options->selection.format == CV_FORMAT_JSON ? sa_lines_write_json(out, report)
                                                       : sa_lines_write_text(out, report);
}

static cv_status write_file(const sa_lines_report *report, const sa_options *options, cv_message *why)
{
    char *bytes = NULL;
    size_t n = 0;
    FILE *memory = open_memstream(&bytes, &n);
    if (memory == NULL)
        return cv_fail(why, CV_FAILED, "out of memory");
    cv_status status = write_as(memory, report, options);
    const int incomplete = ferror(memory);
    if (fclose(memory) != 0 || incomplete || status != CV_OK)
        status = cv_fail(why, CV_FAILED, "out of memory");
    else
        status = cv_output_write(options->output, bytes, n, why);
    free(bytes);
    return status;
}

static cv_status find_and_write(FILE *out, const cv_choice *choice, const sa_lines_range *range,
                                const sa_options *options, cv_message *why)
{
    sa_lines lines;
    sa_resonance_list resonances;
    cv_status status = sa_lines_find(&lines, &choice->params, range, choice->digits, why);
    if (status != CV_OK)
        return status;
    status = sa_resonances(&resonances, &choice->params, choice->digits, why);
    if (status == CV_OK) {
        const sa_lines_report report = {choice->chosen->name, &choice->params, *range,
                                        choice->digits,       &lines,          &resonances};
        if (options->output != NULL)
            status = write_file(&report, options, why);
        else if (write_as(out, &report, options) != CV_OK)
            status = cv_fail(why, CV_FAILED, "out of memory");
    }
    if (status == CV_OK && lines.decided != CV_OK)
        status = cv_fail(why, CV_UNDECIDED, "%s", lines.reason.text);
    sa_resonances_clear(&resonances);
    sa_lines_clear(&lines);
    return status;
}

static cv_status check(const sa_options *options, cv_message *why)
{
    if (options->selection.alpha.given || options->selection.mass_ratio.given)
        return cv_fail(why, CV_BAD_INPUT, "--%s: lines needs a range a:b",
                       options->selection.alpha.given ? "alpha" : "mass-ratio");
    return options->output != NULL ? cv_output_check(options->output, why) : CV_OK;
}

cv_status sa_command_lines(const sa_options *options, const cv_arguments *arguments, FILE *out, FILE *log,
                           cv_message *why)
{
    cv_choice choice;
    cv_number low, high;
    (void)log;
    cv_status status = check(options, why);
    if (status == CV_OK)
        status = cv_choose(&choice, &options->selection, arguments->path, why);
    if (status != CV_OK)
        return status;
    cv_number_init(&low);
    cv_number_init(&high);
    status = cv_number_parse(&low, "1", why);
    if (status == CV_OK)
        status = cv_number_parse(&high, "10000", why);
    const sa_typed_range *a = &options->alphas, *m = &options->masses;
    const sa_lines_range range = {a->given ? &a->low : &choice.file.alpha_min,
                                  a->given ? &a->high : &choice.file.alpha_max, m->given ? &m->low : &low,
                                  m->given ? &m->high : &high};
    if (status == CV_OK)
        status = find_and_write(out, &choice, &range, options, why);
    cv_number_clear(&low);
    cv_number_clear(&high);
    cv_choice_clear(&choice);
    return status;
}
