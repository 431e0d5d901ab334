/* film_words.c: clock, captions and key of a film. */
#include "film_scene.h"

#include "markup.h"

#include <math.h>
#include <string.h>

#define CAPTION 2.5 /* s of the picture that one stays */
#define CAPTION_ROWS 4
#define ROW 24          /* pixels from one to the next */
#define CLOCK_STEPS 200 /* at most */
#define LETTER 6.8      /* mean width of a letter of the key, pixels */

static double speed_of(const struct film *film)
{
    return (film->timeline.to - film->timeline.from) / film->timeline.play;
}

/* ---- clock ----------------------------------------------------------------------------- */

static double clock_step(const struct film *film)
{
    static const double steps[] = {1, 2, 5, 10, 30, 60, 300, 600, 3600};
    double seconds = film->timeline.to - film->timeline.from;
    size_t i = 0;

    while (i + 1 < sizeof steps / sizeof steps[0] && seconds / steps[i] > CLOCK_STEPS)
        i++;
    return steps[i];
}

/* A strip of all the times, of which a window shows one. */
static void draw_clock(struct film *film)
{
    double step = clock_step(film), first = floor(film->timeline.from / step);
    double last = floor(film->timeline.to / step + 1e-9);
    struct track track;

    fprintf(film->out,
            "<g class=\"window\" transform=\"translate(16 10)\"><g class=\"clock\" "
            "transform=\"translate(0 %g)\">",
            -30 * (last - first));
    if (film->moves && film_track(film, &track)) {
        for (double i = first; i <= last; i++)
            track_key(&track, i * step, "0 %g", -30 * (i - first));
        track_close(&track, film->out,
                    "animateTransform attributeName=\"transform\" "
                    "type=\"translate\" calcMode=\"discrete\"");
    }
    for (double i = film->moves ? first : last; i <= last; i++)
        fprintf(film->out, "<text y=\"%g\">%g s</text>", 23 + 30 * (i - first), i * step);
    fputs("</g></g>\n", film->out);
}

/* ---- captions -------------------------------------------------------------------------- */

/* The lowest row that is free at a time of the run; the last one when none is. */
static size_t find_row(const double *busy, double t)
{
    size_t row = 0;

    while (row + 1 < CAPTION_ROWS && busy[row] > t)
        row++;
    return row;
}

static void draw_caption(struct film *film, const struct story *story, size_t row, double until)
{
    struct track track;

    fprintf(film->out, "<text class=\"caption\" x=\"16\" y=\"%g\" visibility=\"hidden\">",
            film->height - 16 - ROW * (double)row);
    if (film_track(film, &track)) {
        track_key(&track, film->timeline.from, "hidden");
        track_key(&track, story->t, "visible");
        if (until < film->timeline.to)
            track_key(&track, until, "hidden");
        track_close(&track, film->out,
                    "animate attributeName=\"visibility\" calcMode=\"discrete\"");
    }
    markup_text(film->out, story->words);
    fputs("</text>\n", film->out);
}

static void draw_captions(struct film *film)
{
    double busy[CAPTION_ROWS] = {0};

    for (size_t i = 0; i < film->stories; i++) {
        const struct story *story = &film->story[i];
        size_t row = find_row(busy, story->t);

        busy[row] = story->t + CAPTION * speed_of(film);
        draw_caption(film, story, row, busy[row]);
    }
}

/* What the eye cannot tell. */
static void draw_measures(struct film *film)
{
    fprintf(film->out,
            "<text class=\"small\" x=\"16\" y=\"56\">%g \u00d7 real time, grid %g m</text>\n",
            speed_of(film), film_grid_step(film));
}

void film_words(struct film *film)
{
    draw_clock(film);
    draw_measures(film);
    if (film->moves)
        draw_captions(film);
}

/* ---- key ------------------------------------------------------------------------------- */

void film_key(struct film *film)
{
    static const struct {
        const char *class, *words;
    } entries[] = {{"L", "leader"}, {"F", "follower"}, {"C", "elects"}, {"X", "lost"}};
    double x = film->width - 16;

    for (size_t i = sizeof entries / sizeof entries[0]; i-- > 0;) {
        x -= LETTER * (double)strlen(entries[i].words);
        fprintf(film->out,
                "<g class=\"%s\" transform=\"translate(%.0f 26)\"><use href=\"#body\" "
                "transform=\"translate(-16 0) scale(%g)\"/><text class=\"small\" "
                "y=\"4\">%s</text></g>\n",
                entries[i].class, x, 0.7 / film->size, entries[i].words);
        x -= 38;
    }
}
