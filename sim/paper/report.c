#include "report.h"

size_t report_verdicts(const struct report *report, enum verdict verdict)
{
    size_t count = 0;

    for (size_t i = 0; i < report->count; i++)
        count += report->figures[i].finding[0].verdict == verdict;
    return count;
}

const char *report_robots(const struct report *report)
{
    return report->avr ? "the firmware's image on simulated ATmega128; native only for the "
                         "baselines of a hundred robots and while gains are matched"
                       : "native, the firmware compiled for the host";
}
