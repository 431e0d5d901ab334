/* diagnosis.h: what is wrong with robots that the doctor has looked at, and what to do. Pure but
 * for the printing. */
#ifndef DIAGNOSIS_H
#define DIAGNOSIS_H

#include "doctor.h"

#include <stdio.h>

/* The image that came with muster. */
struct diagnosis_image {
    bool known;
    uint32_t crc;   /* of its seal */
    uint32_t f_cpu; /* Hz; of all robots */
};

#define DIAGNOSIS_FINDINGS_MAX 12

struct diagnosis {
    size_t count; /* 0: it is good */
    char words[DIAGNOSIS_FINDINGS_MAX][JOB_WORDS_MAX];
};

/* One of them. Beside what it says of itself, it is to run the image that came with muster, or
 * where that is not known the one that most of them run. */
void diagnosis_make(struct diagnosis *diagnosis, const struct doctor_job *jobs, size_t count,
                    size_t i, const struct diagnosis_image *image);

/* A table of figures, and below it the verdict on each. True when all are good. */
bool diagnosis_print(FILE *out, const struct doctor_job *jobs, size_t count,
                     const struct diagnosis_image *image);

#endif
