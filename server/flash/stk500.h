/* stk500.h: the programmer's side of STK500v2 (Atmel AVR068), which the boot loader speaks.
 *
 * A message is 0x1B, sequence number, length of the body (high byte first), 0x0E, body, and the XOR
 * of all bytes before. One request is under way at a time; what answers it has its sequence number
 * and its command, anything else that comes is passed over. Pure: bytes and time in, bytes out. */
#ifndef STK500_H
#define STK500_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum stk500_command {
    STK500_SIGN_ON = 0x01,
    STK500_LOAD_ADDRESS = 0x06,
    STK500_ENTER_PROGMODE = 0x10,
    STK500_LEAVE_PROGMODE = 0x11,
    STK500_PROGRAM_FLASH = 0x13,
    STK500_READ_FLASH = 0x14,
    STK500_SPI_MULTI = 0x1D,
};

#define STK500_OK 0x00

#define STK500_FRAME_BYTES 6 /* of a message, beside its body */
#define STK500_BODY_MAX 266  /* a page to be written, with its head */
#define STK500_MESSAGE_MAX (STK500_FRAME_BYTES + STK500_BODY_MAX)

struct stk500_reader {
    uint16_t count;  /* bytes of a message so far */
    uint16_t length; /* of its body */
    uint8_t sum;
    uint8_t sequence;
    uint8_t body[STK500_BODY_MAX];
};

/* True when a whole message ends with this byte: body[0..length) until the next one. */
bool stk500_read(struct stk500_reader *reader, uint8_t byte);

/* Writes the message, at most STK500_MESSAGE_MAX bytes, and returns its length. */
uint16_t stk500_write(uint8_t *message, uint8_t sequence, const uint8_t *body, uint16_t length);

#define STK500_SLOW_MAX 3

struct stk500 {
    uint32_t baud;
    uint8_t slow;     /* the radio is given 2^slow times the usual delay, STK500_SLOW_MAX at most */
    uint8_t sequence; /* of the request under way */
    uint8_t command;  /* its own; 0: there is none */
    uint16_t answer;  /* bytes of the answer's body */
    uint16_t length, sent;
    uint8_t message[STK500_MESSAGE_MAX];
    int64_t due_us; /* an answer that has not come by then is late; INT64_MAX: not all is sent */
    struct stk500_reader reader;
};

void stk500_begin(struct stk500 *client, uint32_t baud);

/* Asks, and forgets what was asked before. The answer's body has `answer` bytes, two when it
 * refuses. */
void stk500_ask(struct stk500 *client, const uint8_t *body, uint16_t length, uint16_t answer);

/* The requests of an update, asked as above. Addresses and counts are in bytes; a page is what is
 * programmed at once. Reading and programming move the address on. */
void stk500_sign_on(struct stk500 *client);
void stk500_enter_progmode(struct stk500 *client);
void stk500_read_signature(struct stk500 *client, uint8_t byte); /* 0 to 2 */
void stk500_load_address(struct stk500 *client, uint32_t address);
void stk500_read_flash(struct stk500 *client, uint16_t count);
void stk500_program_flash(struct stk500 *client, const uint8_t *bytes, uint16_t count);
void stk500_leave_progmode(struct stk500 *client);

/* Of an answer that was taken: whether the request was done; the signature's byte; the bytes of
 * flash. */
bool stk500_agreed(const struct stk500 *client);
uint8_t stk500_signature(const struct stk500 *client);
const uint8_t *stk500_flash(const struct stk500 *client);

/* Asks nothing more. */
void stk500_forget(struct stk500 *client);

/* What is to be sent of the request, at most `room` bytes. */
size_t stk500_send(struct stk500 *client, int64_t now_us, uint8_t *bytes, size_t room);

/* True when the answer ends with this byte. It is reader.body: command, status (STK500_OK or why
 * not), and what was asked for. Nothing is asked then. */
bool stk500_take(struct stk500 *client, uint8_t byte);

/* The answer should have come by now: the bytes' time, the loader's work and the radio's delay have
 * passed. */
bool stk500_late(const struct stk500 *client, int64_t now_us);

#endif
