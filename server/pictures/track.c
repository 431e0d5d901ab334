#include "track.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

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

static void write_value(struct track *track, const char *format, va_list arguments)
{
    if (track->held)
        fputc(';', track->values);
    vfprintf(track->values, format, arguments);
}

/* Without the zero before the point and those at the end. */
static void write_share(struct track *track, double share)
{
    char digits[16];
    int length = snprintf(digits, sizeof digits, "%.4f", share);

    while (digits[length - 1] == '0')
        length--;
    if (digits[length - 1] == '.')
        length--;
    digits[length] = '\0';
    fprintf(track->times, "%s%s", track->held ? ";" : "",
            digits[0] == '0' && length > 1 ? digits + 1 : digits);
}

void track_key(struct track *track, double t, const char *format, ...)
{
    va_list arguments;
    double share = timeline_share(track->timeline, t);

    for (int again = !track->held && share > 0; again >= 0; again--) {
        write_share(track, again ? 0 : share);
        va_start(arguments, format);
        write_value(track, format, arguments);
        va_end(arguments);
        track->held = true;
    }
}

/* Values that are told at the end are those of the last moment. */
static void hold_last(struct track *track)
{
    fflush(track->values);
    char *last = track->values_text + track->values_length;
    while (last > track->values_text && last[-1] != ';')
        last--;
    char *copy = strndup(last, 256);
    fprintf(track->times, ";1");
    fprintf(track->values, ";%s", copy == NULL ? "" : copy);
    free(copy);
}

void track_close(struct track *track, FILE *out, const char *element)
{
    hold_last(track);
    fclose(track->times);
    fclose(track->values);
    fprintf(out, "<%s dur=\"%gs\" repeatCount=\"indefinite\" keyTimes=\"%s\" values=\"%s\"/>",
            element, track->timeline->total, track->times_text, track->values_text);
    free(track->times_text);
    free(track->values_text);
}
