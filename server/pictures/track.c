#include "track.h"

#include <stdarg.h>
#include <stdlib.h>

double timeline_share(const struct timeline *timeline, double t)
{
    double share = (t - timeline->from) / (timeline->to - timeline->from);

    return (share < 0 ? 0 : share > 1 ? 1 : share) * timeline->play / timeline->total;
}

bool track_open(struct track *track, const struct timeline *timeline)
{
    *track = (struct track){.timeline = timeline};
    track->times = open_memstream(&track->times_text, &track->times_length);
    track->values = open_memstream(&track->values_text, &track->values_length);
    if (track->times != NULL && track->values != NULL)
        return true;
    if (track->times != NULL)
        fclose(track->times);
    if (track->values != NULL)
        fclose(track->values);
    free(track->times_text);
    free(track->values_text);
    return false;
}

/* Without the zero before the point and those at the end. */
static void write_share(FILE *out, double share)
{
    char digits[16];
    int length = snprintf(digits, sizeof digits, "%.4f", share);

    while (digits[length - 1] == '0')
        length--;
    if (digits[length - 1] == '.')
        length--;
    digits[length] = '\0';
    fputs(digits[0] == '0' && length > 1 ? digits + 1 : digits, out);
}

static void write_key(struct track *track, double share)
{
    if (track->begun) {
        fputc(';', track->times);
        fputc(';', track->values);
    }
    write_share(track->times, share);
    fputs(track->last, track->values);
    track->begun = true;
}

void track_key(struct track *track, double t, const char *format, ...)
{
    double share = timeline_share(track->timeline, t);
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(track->last, sizeof track->last, format, arguments);
    va_end(arguments);
    if (!track->begun && share > 0)
        write_key(track, 0);
    write_key(track, share);
}

void track_close(struct track *track, FILE *out, const char *element)
{
    write_key(track, 1);
    fclose(track->times);
    fclose(track->values);
    fprintf(out, "<%s dur=\"%gs\" repeatCount=\"indefinite\" keyTimes=\"%s\" values=\"%s\"/>",
            element, track->timeline->total, track->times_text, track->values_text);
    free(track->times_text);
    free(track->values_text);
}
