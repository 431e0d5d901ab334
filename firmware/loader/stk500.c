#include "stk500.h"

#include "baud.h"
#include "flash.h"
#include "flash_map.h"
#include "slots.h"

#include <avr/pgmspace.h>
#include <avr/wdt.h>
#include <stddef.h>
#include <string.h>
#include <util/delay.h>

/* A message: MESSAGE_START, a number, the length of its body in two bytes, TOKEN, the body, and
 * what makes the exclusive or of all of them 0. */
enum { MESSAGE_START = 0x1B, TOKEN = 0x0E };

#define PROGRAM_HEAD 10 /* what comes before the bytes in PROGRAM_FLASH_ISP */
#define BODY_MAX (PROGRAM_HEAD + FLASH_PAGE_BYTES)

enum command {
    SIGN_ON = 0x01,
    SET_PARAMETER = 0x02,
    GET_PARAMETER = 0x03,
    LOAD_ADDRESS = 0x06,
    ENTER_PROGMODE_ISP = 0x10,
    LEAVE_PROGMODE_ISP = 0x11,
    CHIP_ERASE_ISP = 0x12,
    PROGRAM_FLASH_ISP = 0x13,
    READ_FLASH_ISP = 0x14,
    READ_FUSE_ISP = 0x18,
    READ_LOCK_ISP = 0x1A,
    READ_SIGNATURE_ISP = 0x1B,
    SPI_MULTI = 0x1D,
};

enum status { CMD_OK = 0x00, CMD_FAILED = 0xC0, CMD_UNKNOWN = 0xC9 };

/* A pause within a message that ends it. */
#define GAP_MS 100

#define POLL_US 10
#define POLL_OVERHEAD_US 1
#define POLLS_PER_MS (1000 / POLL_US)

/* Reached through a pointer, which makes shorter code. */
struct session {
    uint16_t address; /* in words */
    bool signed_on;
    bool broken; /* the stage, by this programmer */
    union {
        uint8_t byte[1];
        struct {
            uint8_t start, number, length_high, length_low, token;
            uint8_t body[BODY_MAX + 1]; /* and the sum */
        };
    } message;
};

#define HEAD_BYTES (offsetof(struct session, message.body) - offsetof(struct session, message))

/* ---- messages -------------------------------------------------------------------------- */

/* True when a byte has come before a poll is over. */
static bool poll(void)
{
    wdt_reset();
    if (UCSR0A & _BV(RXC0))
        return true;
    _delay_us(POLL_US - POLL_OVERHEAD_US);
    return false;
}

static uint16_t word_of(const uint8_t *bytes)
{
    return (uint16_t)(bytes[0] << 8 | bytes[1]);
}

static uint16_t body_length(const struct session *session)
{
    return word_of(&session->message.length_high);
}

/* SIGN_ON comes first, and no frame of docs/PROTOCOL.md can be taken for it: the zero and the one
 * that are its length would there be the end of a frame and the beginning of one of type 0. */
static bool head_fits(const struct session *session)
{
    uint16_t length = body_length(session);

    return session->message.start == MESSAGE_START && session->message.token == TOKEN &&
           length > 0 && length <= (session->signed_on ? BODY_MAX : 1);
}

static uint8_t sum_of(const uint8_t *bytes, uint16_t count)
{
    uint8_t sum = 0;

    while (count-- > 0)
        sum ^= *bytes++;
    return sum;
}

/* Waits for a message; true when one has come whole within `ms`. What is none is passed over: a
 * head is looked for at every byte. */
static bool take_message(struct session *session, uint16_t ms)
{
    uint8_t *bytes = session->message.byte;
    uint16_t held = 0;
    uint8_t gap = 0;
    uint8_t part = 0;

    for (;;) {
        if (++part == POLLS_PER_MS) {
            part = 0;
            if (ms != STK500_FOR_EVER && ms-- == 0)
                return false;
            if (++gap == GAP_MS)
                held = 0;
        }
        if (!poll())
            continue;
        gap = 0;
        bytes[held++] = UDR0;
        if (held == HEAD_BYTES && !head_fits(session)) {
            held--;
            memmove(bytes, bytes + 1, HEAD_BYTES - 1);
        } else if (held > HEAD_BYTES && held == HEAD_BYTES + body_length(session) + 1) {
            if (sum_of(bytes, held) == 0)
                return true;
            held = 0;
        }
    }
}

static void send_byte(uint8_t byte)
{
    while (!(UCSR0A & _BV(UDRE0)))
        wdt_reset();
    UCSR0A = BAUD_UCSR0A | _BV(TXC0); /* clears TXC0 */
    UDR0 = byte;
}

/* An answer bears the number of its question. */
static void send_message(struct session *session, uint16_t length)
{
    uint8_t *bytes = session->message.byte;

    session->message.length_high = length >> 8;
    session->message.length_low = length & 0xFF;
    length += HEAD_BYTES;
    bytes[length] = sum_of(bytes, length);
    for (length++; length > 0; length--)
        send_byte(*bytes++);
}

/* ---- commands -------------------------------------------------------------------------- */

/* Each finds its command in the body, leaves its answer there, and returns that one's length. What
 * both begin with has been dealt with: the command itself, the word after it and CMD_OK. */

static uint16_t refuse(uint8_t *body, enum status status)
{
    body[1] = status;
    return 2;
}

static uint16_t sign_on(uint8_t *body)
{
    static const char name[] PROGMEM = "\bAVRISP_2";

    flash_read(body + 2, (LOADER_START & 0x10000) | (uint16_t)name, sizeof name - 1);
    return 2 + sizeof name - 1;
}

static uint16_t break_stage(struct session *session)
{
    stage_break();
    session->broken = true;
    return 2;
}

/* Does it lie in the stage, what begins at the address? */
static bool in_stage(const struct session *session, uint16_t count)
{
    uint16_t words = SLOT_BYTES / 2 - session->address;

    return count > 0 && count <= FLASH_PAGE_BYTES && session->address < SLOT_BYTES / 2 &&
           count <= words << 1;
}

/* A page, or its beginning; the rest becomes blank. */
static uint16_t program_flash(struct session *session, uint16_t count)
{
    uint8_t *body = session->message.body;
    uint16_t at = session->address;

    if (!in_stage(session, count) || at % (FLASH_PAGE_BYTES / 2) != 0 ||
        body_length(session) != PROGRAM_HEAD + count)
        return refuse(body, CMD_FAILED);
    if (!session->broken)
        break_stage(session);
    memset(body + PROGRAM_HEAD + count, 0xFF, FLASH_PAGE_BYTES - count);
    stage_write(at << 1, body + PROGRAM_HEAD);
    session->address = at + (count >> 1);
    return 2;
}

static uint16_t read_flash(struct session *session, uint16_t count)
{
    uint8_t *body = session->message.body;

    if (!in_stage(session, count))
        return refuse(body, CMD_FAILED);
    stage_read(body + 2, session->address << 1, count);
    session->address += count >> 1;
    body[2 + count] = CMD_OK;
    return 3 + count;
}

/* What a chip answers to the four bytes of an instruction of serial programming (data sheet,
 * "Serial Programming Instruction Set"): its signature, or else fuses and lock bits. */
static uint8_t read_chip(const uint8_t *instruction)
{
    uint8_t which = instruction[2];

    if (instruction[0] != 0x30)
        return flash_read_fuses((instruction[0] & 8) >> 3 | (instruction[1] & 8) >> 2);
    return which == 0 ? SIGNATURE_0 : which == 1 ? SIGNATURE_1 : SIGNATURE_2;
}

/* Which byte to fetch, which is always the last, and those to send. */
static uint16_t read_byte(uint8_t *body)
{
    body[2] = read_chip(body + 2);
    body[3] = CMD_OK;
    return 4;
}

/* Bytes to send and to fetch, the first to fetch, and those to send. Each that goes in pushes the
 * one before out. */
static uint16_t spi_multi(uint8_t *body, uint16_t counts)
{
    uint8_t value = read_chip(body + 4);

    if (counts != 0x0404 || body[3] != 0)
        return refuse(body, CMD_FAILED);
    body[3] = body[4];
    body[4] = body[5];
    body[5] = value;
    body[6] = CMD_OK;
    return 7;
}

static uint16_t answer(struct session *session)
{
    uint8_t *body = session->message.body;
    uint16_t word = word_of(body + 1);

    body[1] = CMD_OK;
    switch (body[0]) {
    case SIGN_ON: return sign_on(body);
    case GET_PARAMETER: body[2] = 0; return 3;
    case CHIP_ERASE_ISP: return break_stage(session);
    case PROGRAM_FLASH_ISP: return program_flash(session, word);
    case READ_FLASH_ISP: return read_flash(session, word);
    case READ_FUSE_ISP:
    case READ_LOCK_ISP:
    case READ_SIGNATURE_ISP: return read_byte(body);
    case SPI_MULTI: return spi_multi(body, word);
    case LOAD_ADDRESS: session->address = word_of(body + 3); return 2;
    case SET_PARAMETER:
    case ENTER_PROGMODE_ISP:
    case LEAVE_PROGMODE_ISP: return 2;
    default: return refuse(body, CMD_UNKNOWN);
    }
}

bool stk500_serve(uint16_t window, uint16_t silence)
{
    struct session session;
    uint8_t command = 0;

    session.address = 0;
    session.signed_on = session.broken = false;
    baud_init();
    UCSR0B = _BV(RXEN0) | _BV(TXEN0);
    while (command != LEAVE_PROGMODE_ISP && take_message(&session, window)) {
        command = session.message.body[0];
        session.signed_on |= command == SIGN_ON;
        if (!session.signed_on)
            continue;
        send_message(&session, answer(&session));
        window = silence;
    }
    while (session.signed_on && !(UCSR0A & _BV(TXC0)))
        wdt_reset();
    UCSR0B = 0;
    return session.signed_on;
}
