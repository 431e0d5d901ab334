/* Any bytes from a boot loader: nothing is read or written out of bounds, and what is taken for an
 * answer is one. */
#include "stk500.h"

#include <assert.h>
#include <string.h>

static void look_at(const struct stk500_reader *reader)
{
    uint8_t message[STK500_MESSAGE_MAX];
    struct stk500_reader again = {0};
    bool whole = false;

    assert(reader->length > 0 && reader->length <= STK500_BODY_MAX);
    uint16_t count = stk500_write(message, reader->sequence, reader->body, reader->length);
    for (uint16_t i = 0; i < count; i++) {
        assert(!whole);
        whole = stk500_read(&again, message[i]);
    }
    assert(whole && again.length == reader->length && again.sequence == reader->sequence);
    assert(memcmp(again.body, reader->body, reader->length) == 0);
}

static void read_all(const uint8_t *data, size_t size)
{
    struct stk500_reader reader = {0};

    for (size_t i = 0; i < size; i++)
        if (stk500_read(&reader, data[i]))
            look_at(&reader);
}

/* The first byte is the command, the second one the length of its answer. */
static void ask(const uint8_t *data, size_t size)
{
    struct stk500 client;

    if (size < 2)
        return;
    stk500_begin(&client, 115200);
    stk500_ask(&client, data, 1, data[1]);
    for (size_t i = 2; i < size; i++) {
        if (!stk500_take(&client, data[i]))
            continue;
        const struct stk500_reader *reader = &client.reader;

        assert(reader->body[0] == data[0] && reader->sequence == client.sequence);
        assert(reader->length == data[1] || (reader->length == 2 && reader->body[1] != STK500_OK));
        stk500_ask(&client, data, 1, data[1]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_all(data, size);
    ask(data, size);
    return 0;
}
