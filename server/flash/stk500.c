#include "stk500.h"

#include <string.h>

enum { START = 0x1B, TOKEN = 0x0E };

/* Where in a message its parts lie. */
enum { AT_SEQUENCE = 1, AT_LENGTH_HIGH, AT_LENGTH_LOW, AT_TOKEN, AT_BODY };

#define BITS_PER_BYTE 10

/* What a radio takes there and back at most, usually, and the loader for one request: two pages
 * erased and one written, 4.5 ms each, and some. */
#define RADIO_US 150000
#define WORK_US 50000

static bool restart(struct stk500_reader *reader)
{
    reader->count = 0;
    return false;
}

bool stk500_read(struct stk500_reader *reader, uint8_t byte)
{
    uint16_t at = reader->count++;

    if (at == 0)
        reader->sum = 0;
    reader->sum ^= byte;
    switch (at) {
    case 0: return byte == START ? false : restart(reader);
    case AT_SEQUENCE: reader->sequence = byte; return false;
    case AT_LENGTH_HIGH: reader->length = (uint16_t)(byte << 8); return false;
    case AT_LENGTH_LOW:
        reader->length |= byte;
        return reader->length == 0 || reader->length > STK500_BODY_MAX ? restart(reader) : false;
    case AT_TOKEN: return byte == TOKEN ? false : restart(reader);
    default: break;
    }
    if (at < AT_BODY + reader->length) {
        reader->body[at - AT_BODY] = byte;
        return false;
    }
    reader->count = 0;
    return reader->sum == 0;
}

uint16_t stk500_write(uint8_t *message, uint8_t sequence, const uint8_t *body, uint16_t length)
{
    uint8_t sum = 0;

    message[0] = START;
    message[AT_SEQUENCE] = sequence;
    message[AT_LENGTH_HIGH] = (uint8_t)(length >> 8);
    message[AT_LENGTH_LOW] = (uint8_t)length;
    message[AT_TOKEN] = TOKEN;
    memcpy(message + AT_BODY, body, length);
    for (uint16_t i = 0; i < AT_BODY + length; i++)
        sum ^= message[i];
    message[AT_BODY + length] = sum;
    return (uint16_t)(STK500_FRAME_BYTES + length);
}

void stk500_begin(struct stk500 *client, uint32_t baud)
{
    memset(client, 0, sizeof *client);
    client->baud = baud;
}

void stk500_ask(struct stk500 *client, const uint8_t *body, uint16_t length, uint16_t answer)
{
    client->command = body[0];
    client->answer = answer;
    client->length = stk500_write(client->message, ++client->sequence, body, length);
    client->sent = 0;
    client->due_us = INT64_MAX;
    client->reader.count = 0;
}

void stk500_forget(struct stk500 *client)
{
    client->command = 0;
    client->sent = client->length = 0;
}

static int64_t patience_us(const struct stk500 *client)
{
    int64_t bytes = client->length + client->answer + STK500_FRAME_BYTES;

    return bytes * BITS_PER_BYTE * 1000000 / client->baud + (RADIO_US << client->slow) + WORK_US;
}

size_t stk500_send(struct stk500 *client, int64_t now_us, uint8_t *bytes, size_t room)
{
    size_t left = (size_t)(client->length - client->sent);
    size_t part = left < room ? left : room;

    memcpy(bytes, client->message + client->sent, part);
    client->sent += (uint16_t)part;
    if (part > 0 && part == left)
        client->due_us = now_us + patience_us(client);
    return part;
}

bool stk500_take(struct stk500 *client, uint8_t byte)
{
    const struct stk500_reader *reader = &client->reader;

    if (!stk500_read(&client->reader, byte))
        return false;
    if (client->command == 0 || reader->sequence != client->sequence ||
        reader->body[0] != client->command)
        return false;
    bool refused = reader->length == 2 && reader->body[1] != STK500_OK;
    if (!refused && reader->length != client->answer)
        return false;
    stk500_forget(client);
    return true;
}

bool stk500_late(const struct stk500 *client, int64_t now_us)
{
    return client->command != 0 && now_us >= client->due_us;
}

/* ---- requests -------------------------------------------------------------------------- */

/* What a programmer tells of times and tries is for other chips than a loader's own: it passes over
 * that. Numbers of two bytes have the high one first. */

void stk500_sign_on(struct stk500 *client)
{
    static const uint8_t body[] = {STK500_SIGN_ON};

    stk500_ask(client, body, sizeof body, 3 + 8); /* and "AVRISP_2" with its length */
}

void stk500_enter_progmode(struct stk500 *client)
{
    static const uint8_t body[] = {
        STK500_ENTER_PROGMODE, 200, 100, 25, 32, 0, 0x53, 3, 0xAC, 0x53, 0, 0};

    stk500_ask(client, body, sizeof body, 2);
}

void stk500_read_signature(struct stk500 *client, uint8_t byte)
{
    const uint8_t body[] = {STK500_SPI_MULTI, 4, 4, 0, 0x30, 0, byte, 0};

    stk500_ask(client, body, sizeof body, 7);
}

void stk500_load_address(struct stk500 *client, uint32_t address)
{
    uint32_t word = address / 2;
    const uint8_t body[] = {STK500_LOAD_ADDRESS, (uint8_t)(word >> 24), (uint8_t)(word >> 16),
                            (uint8_t)(word >> 8), (uint8_t)word};

    stk500_ask(client, body, sizeof body, 2);
}

void stk500_read_flash(struct stk500 *client, uint16_t count)
{
    const uint8_t body[] = {STK500_READ_FLASH, (uint8_t)(count >> 8), (uint8_t)count, 0x20};

    stk500_ask(client, body, sizeof body, (uint16_t)(3 + count));
}

void stk500_program_flash(struct stk500 *client, const uint8_t *bytes, uint16_t count)
{
    const uint8_t head[] = {STK500_PROGRAM_FLASH,
                            (uint8_t)(count >> 8),
                            (uint8_t)count,
                            0xC1,
                            10,
                            0x40,
                            0x4C,
                            0x20,
                            0,
                            0};
    uint8_t body[STK500_BODY_MAX];

    memcpy(body, head, sizeof head);
    memcpy(body + sizeof head, bytes, count);
    stk500_ask(client, body, (uint16_t)(sizeof head + count), 2);
}

void stk500_leave_progmode(struct stk500 *client)
{
    static const uint8_t body[] = {STK500_LEAVE_PROGMODE, 1, 1};

    stk500_ask(client, body, sizeof body, 2);
}

bool stk500_agreed(const struct stk500 *client)
{
    return client->reader.body[1] == STK500_OK;
}

uint8_t stk500_signature(const struct stk500 *client)
{
    return client->reader.body[5];
}

const uint8_t *stk500_flash(const struct stk500 *client)
{
    return client->reader.body + 2;
}
