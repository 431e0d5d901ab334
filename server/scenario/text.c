#include "text.h"

#include <stdbool.h>
#include <string.h>

#define WORD_MAX 31

/* Length and smallest code point of the UTF-8 sequence that begins with `lead`; 0 for none. */
static size_t sequence_length(unsigned char lead, unsigned *smallest)
{
    if (lead >= 0xC2 && lead <= 0xDF) {
        *smallest = 0x80;
        return 2;
    }
    if (lead >= 0xE0 && lead <= 0xEF) {
        *smallest = 0x800;
        return 3;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        *smallest = 0x10000;
        return 4;
    }
    return 0;
}

/* The bytes of the character that `bytes` begins with, 0 when it is not text. */
static size_t character_length(const unsigned char *bytes, size_t left)
{
    if (bytes[0] < 0x80) {
        bool plain = bytes[0] >= 0x20 && bytes[0] != 0x7F;
        return plain || bytes[0] == '\t' || bytes[0] == '\n' || bytes[0] == '\r';
    }

    unsigned smallest;
    size_t length = sequence_length(bytes[0], &smallest);
    if (length == 0 || length > left)
        return 0;

    unsigned code = bytes[0] & (0x7Fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((bytes[i] & 0xC0) != 0x80)
            return 0;
        code = code << 6 | (bytes[i] & 0x3Fu);
    }
    bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    return code >= smallest && code <= 0x10FFFF && !surrogate ? length : 0;
}

size_t text_length(const char *bytes, size_t length)
{
    size_t at = 0;

    while (at < length) {
        size_t step = character_length((const unsigned char *)bytes + at, length - at);
        if (step == 0)
            break;
        at += step;
    }
    return at;
}

static unsigned min3(unsigned a, unsigned b, unsigned c)
{
    unsigned least = a < b ? a : b;

    return least < c ? least : c;
}

unsigned text_distance(const char *a, const char *b)
{
    size_t rows = strlen(a);
    size_t columns = strlen(b);

    if (rows > WORD_MAX || columns > WORD_MAX)
        return WORD_MAX + 1;

    unsigned d[WORD_MAX + 1][WORD_MAX + 1];
    for (size_t j = 0; j <= columns; j++)
        d[0][j] = j;
    for (size_t i = 1; i <= rows; i++) {
        d[i][0] = i;
        for (size_t j = 1; j <= columns; j++) {
            unsigned change = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j] = min3(d[i - 1][j] + 1, d[i][j - 1] + 1, change);
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && d[i - 2][j - 2] + 1 < d[i][j])
                d[i][j] = d[i - 2][j - 2] + 1;
        }
    }
    return d[rows][columns];
}

const char *text_nearest(const char *word, const char *const *list)
{
    const char *nearest = NULL;
    size_t third = strlen(word) / 3; /* more changes than that make another word */
    unsigned least = third > 1 ? (unsigned)third + 1 : 2;

    for (; *list != NULL; list++) {
        unsigned distance = text_distance(word, *list);
        if (distance < least && distance < strlen(*list)) {
            least = distance;
            nearest = *list;
        }
    }
    return nearest;
}
