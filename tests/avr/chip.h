/* chip.h: an image in a simulated ATmega128, for the verdicts in this folder.
 *
 * The verdict is the host's alone. A test that waits for its image in vain fails: an image has to
 * say REPORT_END (report.h) to have run to its end. */
#ifndef CHIP_H
#define CHIP_H

#include "avr_core.h"
#include "message.h"

struct chip {
    struct avr_image *image;
    struct avr_core *core;
    struct frame_decoder decoder;
};

/* Where a test finds its image: its one argument. */
extern const char *chip_path;

/* Reads the image and switches the chip on; blank EEPROM. */
void chip_start(struct chip *chip);
void chip_stop(struct chip *chip);

void chip_run_us(struct chip *chip, uint32_t us);

/* Runs until the status LED is lit: an image's way of saying that it is ready. */
void chip_await_led(struct chip *chip);

/* Runs until the chip has sent `count` bytes. */
void chip_read(struct chip *chip, uint8_t *bytes, size_t count);

/* Runs until the chip has sent REPORT_END, with nothing before it. */
void chip_await_end(struct chip *chip);

/* Sends bytes to the chip, starting now, and runs until all have arrived. */
void chip_write(struct chip *chip, const uint8_t *bytes, size_t count);

#endif
