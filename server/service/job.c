#include "job.h"

#include <stdarg.h>
#include <stdio.h>

static void end(struct job *job, enum job_state state, const char *format, va_list arguments)
{
    job->state = state;
    vsnprintf(job->words, sizeof job->words, format, arguments);
}

void job_done(struct job *job, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    end(job, JOB_DONE, format, arguments);
    va_end(arguments);
    job->progress = 1;
}

void job_failed(struct job *job, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    end(job, JOB_FAILED, format, arguments);
    va_end(arguments);
}
