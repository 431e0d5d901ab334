#include "marks.h"

#include "mark.h"

#include <err.h>
#include <stdio.h>
#include <stdlib.h>

#define STEP_CYCLES 1000 /* no image says more in this time than the queue holds */
#define PATIENCE_CYCLES 1000000000u
#define RET_CYCLES 4

static void hear(void *listener, uint8_t byte, uint64_t cycle)
{
    struct marks *marks = listener;

    marks->queue[marks->heard++] = (struct mark){byte, cycle};
}

static struct mark next(struct marks *marks)
{
    uint64_t limit = avr_core_cycle(marks->core) + PATIENCE_CYCLES;

    while (marks->taken == marks->heard) {
        uint64_t now = avr_core_cycle(marks->core);

        marks->taken = marks->heard = 0;
        if (now > limit || !avr_core_run(marks->core, now + STEP_CYCLES))
            errx(EXIT_FAILURE, "%s.elf stopped before it had said all", marks->name);
    }
    return marks->queue[marks->taken++];
}

static uint64_t expect(struct marks *marks, uint8_t byte)
{
    struct mark mark = next(marks);

    if (mark.byte != byte)
        errx(EXIT_FAILURE, "%s.elf says other things than its verdict expects", marks->name);
    return mark.cycle;
}

static uint64_t measure(struct marks *marks)
{
    uint64_t begin = expect(marks, MARK_BEGIN);

    return expect(marks, MARK_END) - begin;
}

void marks_open(struct marks *marks, const char *name)
{
    char path[512];
    char error[600] = "";

    *marks = (struct marks){.name = name};
    snprintf(path, sizeof path, "%s/%s.elf", BENCH_IMAGES, name);
    marks->image = avr_image_open(path, error, sizeof error);
    if (marks->image == NULL)
        errx(EXIT_FAILURE, "%s", error);
    marks->core = avr_core_new(marks->image);
    if (marks->core == NULL)
        errx(EXIT_FAILURE, "no memory for a chip");
    avr_core_on_debug(marks->core, hear, marks);
    marks->empty = measure(marks);
    uint32_t known = marks_measure(marks, NULL, 0);
    if (known != KNOWN_CYCLES + RET_CYCLES)
        errx(EXIT_FAILURE, "%s.elf: %d cycles are counted as %u", name, KNOWN_CYCLES + RET_CYCLES,
             known);
}

uint32_t marks_measure(struct marks *marks, void *result, size_t size)
{
    uint8_t *bytes = result;
    uint64_t cycles = measure(marks) - marks->empty + RET_CYCLES;

    for (size_t i = 0; i < size; i++)
        bytes[i] = next(marks).byte;
    return (uint32_t)cycles;
}

void marks_close(struct marks *marks)
{
    expect(marks, MARK_DONE);
    avr_core_free(marks->core);
    avr_image_close(marks->image);
}
