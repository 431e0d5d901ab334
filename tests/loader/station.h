/* station.h: a chip with a boot loader, and a programmer that speaks STK500v2 to it byte by byte.
 *
 * Power can be cut while any page is erased or written: the chip then does nothing more, and what
 * the programmer does is in vain until the chip is switched on again. */
#ifndef STATION_H
#define STATION_H

#include "avr_core.h"
#include "own_flash.h"

#define BODY_MAX 275

struct station {
    struct avr_image *loader;
    struct own_flash *flash;
    struct avr_core *core; /* NULL: off */
    unsigned cut_at; /* power is cut amid this one of flash->operations, from 1 on; 0: never */
    uint8_t number;  /* of the last message */
    uint16_t length; /* of the last answer */
    uint8_t answer[BODY_MAX];
};

struct avr_image *station_open(const char *path);

/* With that program in its slot; NULL: with none. Off. */
void station_begin(struct station *station, struct avr_image *loader,
                   const struct avr_image *program);
void station_end(struct station *station);

void station_power_on(struct station *station);
void station_power_off(struct station *station);

/* Runs it; false when it is off, or has gone off meanwhile. */
bool station_run_us(struct station *station, uint32_t us);

/* Sends bytes as they are, and runs until the last has arrived. */
void station_send(struct station *station, const uint8_t *bytes, size_t count);

/* Runs until it sends a byte, `us` at the most; -1: it did not. */
int station_hear(struct station *station, uint32_t us);

/* Sends a message; without waiting. */
void station_ask(struct station *station, const uint8_t *body, uint16_t length);

/* The same, and takes the answer; its status, -1 when none comes. */
int station_command(struct station *station, const uint8_t *body, uint16_t length);

/* Signs on; false when the loader is not there. */
bool station_sign_on(struct station *station);

/* One page of the stage, from 0 on. The answer's status. */
int station_write_page(struct station *station, uint16_t at, const uint8_t *bytes, uint16_t count);

/* All of a program, as avrdude would: sign on, erase, write, leave. False where anything of it
 * was not answered well. */
bool station_update(struct station *station, const struct avr_image *program);

#endif
