#include "param_table.h"

#include "parameter_words.h"

#include <string.h>

#define GAP "  "

static const char *words_of(size_t row, const struct param_reading *reading,
                            char words[PARAMETER_WORDS_MAX])
{
    return reading->known ? parameter_words(param_index(row), reading->value, words) : "unknown";
}

static const char *name_of(size_t row)
{
    return parameter_line(param_index(row))->name;
}

/* ---- the table itself ------------------------------------------------------------------ */

static void print_line(FILE *out, uint8_t index)
{
    const struct parameter_line *line = parameter_line(index);
    char low[PARAMETER_WORDS_MAX], high[PARAMETER_WORDS_MAX], unless[PARAMETER_WORDS_MAX];

    if (parameter_is_stored(index))
        fprintf(out, "%-17s %-5s %-9s %-9s %-9s %-7s %s\n", line->name, line->unit,
                parameter_number(index, line->low, low), parameter_number(index, line->high, high),
                parameter_number(index, line->unless_set, unless), "yes", line->about);
    else
        fprintf(out, "%-17s %-5s %-9s %-9s %-9s %-7s %s\n", line->name, line->unit, "-", "-", "-",
                "no", line->about);
}

void param_table_print_all(FILE *out)
{
    fprintf(out, "%-17s %-5s %-9s %-9s %-9s %-7s %s\n", "name", "unit", "from", "to", "default",
            "stored", "what it is");
    for (size_t row = 0; row < PARAM_ROWS; row++)
        print_line(out, param_index(row));
}

/* ---- what was read --------------------------------------------------------------------- */

static bool is_done(const struct param_job *job)
{
    return job->job.state == JOB_DONE;
}

static bool is_same_in_all(const struct param_job *jobs, size_t count, size_t row)
{
    const struct param_reading *first = NULL;

    for (size_t i = 0; i < count; i++) {
        const struct param_reading *reading = &jobs[i].before[row];

        if (!is_done(&jobs[i]))
            continue;
        if (first == NULL)
            first = reading;
        else if (reading->known != first->known || reading->value != first->value)
            return false;
    }
    return true;
}

static int width_of(const struct param_job *jobs, size_t count, size_t row)
{
    size_t width = strlen(name_of(row));
    char words[PARAMETER_WORDS_MAX];

    for (size_t i = 0; i < count; i++) {
        size_t length = is_done(&jobs[i]) ? strlen(words_of(row, &jobs[i].before[row], words)) : 0;

        if (length > width)
            width = length;
    }
    return (int)width;
}

static void print_same(FILE *out, const struct param_job *job, uint64_t rows, size_t done)
{
    char words[PARAMETER_WORDS_MAX];

    if (done > 1)
        fprintf(out, "the same in all %zu robots:\n", done);
    for (size_t row = 0; row < PARAM_ROWS; row++)
        if (rows >> row & 1)
            fprintf(out, "%s%-17s %s\n", done > 1 ? GAP : "", name_of(row),
                    words_of(row, &job->before[row], words));
}

static bool is_unsaved(const struct param_job *job)
{
    return job->before[param_row(PARAMETER_UNSAVED)].value != 0;
}

static void print_columns(FILE *out, const struct param_job *jobs, size_t count, uint64_t rows)
{
    char words[PARAMETER_WORDS_MAX];

    fputs("robot ", out);
    for (size_t row = 0; row < PARAM_ROWS; row++)
        if (rows >> row & 1)
            fprintf(out, GAP "%*s", width_of(jobs, count, row), name_of(row));
    fputc('\n', out);
    for (size_t i = 0; i < count; i++) {
        if (!is_done(&jobs[i]))
            continue;
        fprintf(out, "%5u%c", jobs[i].job.robot, is_unsaved(&jobs[i]) ? '*' : ' ');
        for (size_t row = 0; row < PARAM_ROWS; row++)
            if (rows >> row & 1)
                fprintf(out, GAP "%*s", width_of(jobs, count, row),
                        words_of(row, &jobs[i].before[row], words));
        fputc('\n', out);
    }
}

void param_table_print(FILE *out, const struct param_job *jobs, size_t count, uint64_t rows,
                       bool folded)
{
    const struct param_job *first = NULL;
    uint64_t same = 0;
    size_t done = 0, unsaved = 0;

    for (size_t i = 0; i < count; i++) {
        if (is_done(&jobs[i]) && done++ == 0)
            first = &jobs[i];
        unsaved += is_done(&jobs[i]) && is_unsaved(&jobs[i]);
    }
    if (first == NULL)
        return;
    for (size_t row = 0; folded && row < PARAM_ROWS; row++)
        if (is_same_in_all(jobs, count, row))
            same |= rows & UINT64_C(1) << row;
    if (same != 0)
        print_same(out, first, same, done);
    if (rows != same)
        print_columns(out, jobs, count, rows & ~same);
    if (unsaved > 0)
        fprintf(out,
                "%s not saved: `muster param save' keeps it, a power cycle brings the old values "
                "back\n",
                rows != same ? "*" : "Something is");
}

/* ---- what was changed ------------------------------------------------------------------ */

static void print_change(FILE *out, const struct param_job *job, size_t row)
{
    const struct param_reading *was = &job->before[row], *is = &job->after[row];
    char old[PARAMETER_WORDS_MAX], new[PARAMETER_WORDS_MAX];

    if (was->known && was->value == is->value)
        fprintf(out, "robot %u: %s is %s already\n", job->job.robot, name_of(row),
                words_of(row, is, new));
    else
        fprintf(out, "robot %u: %s %s -> %s\n", job->job.robot, name_of(row),
                words_of(row, was, old), words_of(row, is, new));
}

void param_table_print_changes(FILE *out, const struct param_job *jobs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct param_job *job = &jobs[i];

        for (size_t row = 0; is_done(job) && row < PARAMETERS_STORED_COUNT; row++) {
            bool reset = job->plan.reset && job->before[row].value != job->after[row].value;

            if (job->plan.set >> row & 1 || reset)
                print_change(out, job, row);
        }
    }
}
