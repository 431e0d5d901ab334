#include "job.h"

#include <stdarg.h>
#include <stdio.h>

void job_done(struct job *job, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(job->words, sizeof job->words, format, arguments);
    va_end(arguments);
    job->progress = 1;
    job->state = JOB_DONE;
}

void job_failed(struct job *job, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(job->words, sizeof job->words, format, arguments);
    va_end(arguments);
    job->state = JOB_FAILED;
}
