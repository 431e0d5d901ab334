#include "tape.h"

#include "mcap_reader.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define NS_PER_MS 1000000

struct topic_of {
    uint16_t channel;
    char *name;
};

struct tape {
    FILE *file;
    struct mcap_reader *reader;
    struct tape_about about;
    struct topic_of *topic;
    size_t topic_count;
    struct mcap_record record; /* the newest message */
    enum mcap_news news;       /* MCAP_RECORD while there is one */
    bool wound;                /* it has not been asked for yet */
};

bool tape_path(char *file, size_t room, const char *path)
{
    struct stat status;
    bool folder = stat(path, &status) == 0 && S_ISDIR(status.st_mode);

    return snprintf(file, room, folder ? "%s/run.mcap" : "%s", path) < (int)room;
}

static bool is_text(const struct mcap_text *text, const char *word)
{
    return text->length == strlen(word) && memcmp(text->at, word, text->length) == 0;
}

static const struct topic_of *find_topic(const struct tape *tape, uint16_t channel)
{
    for (size_t i = 0; i < tape->topic_count; i++)
        if (tape->topic[i].channel == channel)
            return &tape->topic[i];
    return NULL;
}

static bool add_topic(struct tape *tape, const struct mcap_record *record)
{
    size_t count = tape->topic_count;

    if (find_topic(tape, record->id) != NULL)
        return true;
    struct topic_of *topic = realloc(tape->topic, (count + 1) * sizeof *topic);
    if (topic == NULL)
        return false;
    tape->topic = topic;
    topic[count] = (struct topic_of){record->id, strndup(record->name.at, record->name.length)};
    if (topic[count].name == NULL)
        return false;
    tape->topic_count++;
    return true;
}

/* People will see it, on a terminal perhaps; a run's own words are ASCII. */
static void keep(char word[TAPE_WORD_MAX], const struct mcap_text *value)
{
    size_t length = value->length < TAPE_WORD_MAX ? value->length : TAPE_WORD_MAX - 1;

    for (size_t i = 0; i < length; i++)
        word[i] = value->at[i] < ' ' || value->at[i] > '~' ? '?' : value->at[i];
    word[length] = '\0';
}

static double seconds(const char *word)
{
    double value = strtod(word, NULL);

    return value > 0 && isfinite(value) ? value : 0;
}

static void take_about(struct tape_about *about, const struct mcap_text *key,
                       const struct mcap_text *value)
{
    char word[TAPE_WORD_MAX];

    keep(word, value);
    if (is_text(key, "scenario"))
        strcpy(about->scenario, word);
    else if (is_text(key, "robots"))
        strcpy(about->robots, word);
    else if (is_text(key, "seed"))
        about->seed = strtoull(word, NULL, 10);
    else if (is_text(key, "duration"))
        about->duration = seconds(word);
}

static void take_metadata(struct tape *tape, const struct mcap_record *record)
{
    struct mcap_text map = record->value, key, value;

    if (!is_text(&record->name, "muster"))
        return;
    while (mcap_pair(&map, &key, &value))
        take_about(&tape->about, &key, &value);
}

static bool is_ours(const struct tape *tape, const struct mcap_record *record)
{
    return record->opcode == MCAP_MESSAGE && record->time_ns / NS_PER_MS <= INT32_MAX &&
           find_topic(tape, record->id) != NULL;
}

/* To the next message: MCAP_RECORD. */
static enum mcap_news wind(struct tape *tape)
{
    struct mcap_record *record = &tape->record;
    enum mcap_news news;

    while ((news = mcap_reader_next(tape->reader, record)) <= MCAP_CUT) {
        if (news == MCAP_CUT)
            continue;
        if (is_ours(tape, record))
            break;
        if (record->opcode == MCAP_METADATA)
            take_metadata(tape, record);
        if (record->opcode == MCAP_CHANNEL && !add_topic(tape, record))
            return MCAP_FAILED;
    }
    return news;
}

/* The header, and all up to the first message. */
static bool begin(struct tape *tape, const char *path, char *error, size_t room)
{
    tape->reader = mcap_reader_open(tape->file);
    if (tape->reader == NULL) {
        snprintf(error, room, "%s cannot be read: %s", path, strerror(errno));
        return false;
    }
    tape->about.whole = mcap_reader_has_end(tape->reader);
    tape->news = mcap_reader_next(tape->reader, &tape->record);
    bool ros = tape->news == MCAP_RECORD && is_text(&tape->record.name, "ros2");
    if (ros)
        tape->news = wind(tape);
    if (tape->news == MCAP_REFUSED || tape->news == MCAP_FAILED)
        snprintf(error, room, "%s %s", path, mcap_reader_words(tape->reader));
    else if (!ros)
        snprintf(error, room, "%s is no recording of profile ros2", path);
    return ros && tape->news != MCAP_REFUSED && tape->news != MCAP_FAILED;
}

struct tape *tape_open(const char *path, char *error, size_t room)
{
    char file[4096];
    struct tape *tape = calloc(1, sizeof *tape);

    if (tape == NULL || !tape_path(file, sizeof file, path)) {
        snprintf(error, room, tape == NULL ? "no memory" : "%s: the path is too long", path);
        free(tape);
        return NULL;
    }
    tape->file = fopen(file, "re");
    if (tape->file == NULL)
        snprintf(error, room, "cannot read %s: %s", file, strerror(errno));
    if (tape->file == NULL || !begin(tape, file, error, room)) {
        tape_close(tape);
        return NULL;
    }
    tape->wound = true;
    return tape;
}

const struct tape_about *tape_about(const struct tape *tape)
{
    return &tape->about;
}

bool tape_next(struct tape *tape, struct tape_message *message)
{
    const struct mcap_record *record = &tape->record;

    if (tape->news == MCAP_RECORD && !tape->wound)
        tape->news = wind(tape);
    tape->wound = false;
    if (tape->news != MCAP_RECORD)
        return false;
    *message = (struct tape_message){
        .topic = find_topic(tape, record->id)->name,
        .time_ms = (int32_t)(record->time_ns / NS_PER_MS),
        .bytes = record->data,
        .count = record->data_count,
    };
    return true;
}

void tape_close(struct tape *tape)
{
    if (tape == NULL)
        return;
    mcap_reader_close(tape->reader);
    if (tape->file != NULL)
        fclose(tape->file);
    for (size_t i = 0; i < tape->topic_count; i++)
        free(tape->topic[i].name);
    free(tape->topic);
    free(tape);
}
