/* request.h: what a viewer asks for, in JSON (docs/VIEWING.md): nothing happens without the token,
 * and nothing that is not exactly a request. */
#ifndef REQUEST_H
#define REQUEST_H

#include "act.h"

#define REQUEST_BYTES_MAX 8192
#define REQUEST_WORDS_MAX 200

enum request_end {
    REQUEST_GOOD,
    REQUEST_REFUSED,      /* why not in `words`; the act's number is set */
    REQUEST_UNANSWERABLE, /* it has no number */
};

struct request_rules {
    const char *token;
    const char *kind; /* view_about */
    uint32_t acts;    /* ACT_BIT() of what may be asked for */
};

/* Fills in the act but for its viewer. It may be used when the end is good, else its number only.
 */
enum request_end request_read(const struct request_rules *rules, const char *text, size_t count,
                              struct act *act, char words[REQUEST_WORDS_MAX]);

#endif
