/* foxglove.c: any texts from a viewer of Foxglove's kind, one a line: nothing is read or written
 * out of bounds, subscriptions stay one to a topic and an id, and whatever is refused is told so.
 */
#include "foxglove.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static void look_at(const struct foxglove *viewer)
{
    for (enum topic topic = 0; topic < TOPIC_COUNT; topic++) {
        assert(viewer->wanted[topic] || !viewer->fresh[topic]);
        for (enum topic other = 0; other < topic; other++)
            assert(!viewer->wanted[topic] || !viewer->wanted[other] ||
                   viewer->subscription[topic] != viewer->subscription[other]);
    }
}

static void hear(struct foxglove *viewer, const uint8_t *data, size_t count)
{
    char *text = malloc(count + 1), *reply = malloc(FOXGLOVE_REPLY_MAX);
    uint8_t head[FOXGLOVE_HEAD];

    assert(text != NULL && reply != NULL);
    memcpy(text, data, count);
    memset(reply, 'x', FOXGLOVE_REPLY_MAX);
    if (!foxglove_hear_text(viewer, text, count, reply))
        assert(memchr(reply, '\0', FOXGLOVE_REPLY_MAX) != NULL);
    look_at(viewer);
    foxglove_head(viewer, TOPIC_TF, 0, head);
    free(reply);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct foxglove viewer = {0};

    for (size_t done = 0; done < size;) {
        const uint8_t *end = memchr(data + done, '\n', size - done);
        size_t count = end != NULL ? (size_t)(end - data) - done : size - done;

        hear(&viewer, data + done, count);
        done += count + 1;
    }
    return 0;
}
