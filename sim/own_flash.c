#include "own_flash.h"

#include <avr_flash.h>
#include <sim_io.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* From the writing of SPMCSR to the instruction that it is for: four cycles, and the write's own.
 */
#define ARMED_CYCLES 6

enum { OPCODE_LPM_R0 = 0x95C8, OPCODE_ELPM_R0 = 0x95D8 };
enum { REGISTER_ZL = 30, REGISTER_ZH = 31, BLANK = 0xFF };

/* By Z: what firmware/program.sh makes of a chip. */
static const uint8_t fuses[4] = {0x3F, 0xEF, 0xFF, 0x84};

struct own_flash *own_flash_new(void)
{
    struct own_flash *flash = calloc(1, sizeof *flash);

    if (flash != NULL)
        memset(flash->bytes, BLANK, FLASH_BYTES);
    return flash;
}

void own_flash_put_program(struct own_flash *flash, const struct avr_image *program)
{
    memcpy(flash->bytes, program->flash, SLOT_BYTES);
}

void own_flash_put_loader(struct own_flash *flash, const struct avr_image *loader)
{
    memcpy(flash->bytes + LOADER_START, loader->flash + LOADER_START,
           sizeof flash->bytes - LOADER_START);
}

static void blame(struct own_flash *flash, const char *words)
{
    if (flash->fault == NULL)
        flash->fault = words;
}

/* The next instruction is watched. */
static void end_burst(avr_t *avr)
{
    avr->run_cycle_count = 0;
}

static uint32_t z_of(const avr_t *avr)
{
    return (uint32_t)(avr->data[REGISTER_ZL] | avr->data[REGISTER_ZH] << 8);
}

/* ---- storing --------------------------------------------------------------------------- */

/* Another one each time, and the same in every run. */
static void fill_with_rubbish(struct own_flash *flash)
{
    uint32_t state = flash->page + flash->operations;

    for (int i = 0; i < FLASH_PAGE_BYTES; i++) {
        state = state * 1664525u + 1013904223u;
        flash->bytes[flash->page + i] = (uint8_t)(state >> 24);
    }
}

static avr_cycle_count_t end_operation(avr_t *avr, avr_cycle_count_t when, void *param)
{
    struct own_flash *flash = param;

    (void)when;
    memcpy(flash->bytes + flash->page, flash->coming, FLASH_PAGE_BYTES);
    flash->busy = false;
    avr->data[SPMCSR] &= SPM_BLOCKED;
    return 0;
}

/* What becomes of a page. Writing turns ones into zeros and never the other way. */
static void prepare(struct own_flash *flash, uint8_t command)
{
    for (int i = 0; i < FLASH_PAGE_BYTES; i++)
        flash->coming[i] =
            command & SPM_ERASE ? BLANK : flash->bytes[flash->page + i] & flash->buffer[i];
    if (command & SPM_WRITE)
        memset(flash->buffer, BLANK, sizeof flash->buffer);
}

/* The processor goes on, also where a chip's would be held until it is done: a loader waits. */
static void begin_operation(struct own_flash *flash, uint32_t at, uint8_t command)
{
    avr_t *avr = flash->avr;

    flash->page = at - at % FLASH_PAGE_BYTES;
    if (flash->page >= LOADER_START) {
        blame(flash, "a page of the loader was to be erased or written");
        return;
    }
    prepare(flash, command);
    flash->operations++;
    fill_with_rubbish(flash);
    flash->busy = true;
    if (flash->page < FLASH_RWW_BYTES)
        avr->data[SPMCSR] |= SPM_BLOCKED;
    avr_cycle_timer_register(avr, (uint64_t)avr->frequency * FLASH_BUSY_US / 1000000, end_operation,
                             flash);
}

static void fill_buffer(struct own_flash *flash, uint32_t at)
{
    at %= FLASH_PAGE_BYTES;
    flash->buffer[at & ~1u] = flash->avr->data[0];
    flash->buffer[at | 1u] = flash->avr->data[1];
}

static void execute(struct own_flash *flash, uint8_t command)
{
    avr_t *avr = flash->avr;
    uint32_t at = z_of(avr) | (uint32_t)(avr->data[RAMPZ] & 1) << 16;

    switch (command) {
    case SPM_ENABLE: fill_buffer(flash, at); break;
    case SPM_ERASE | SPM_ENABLE:
    case SPM_WRITE | SPM_ENABLE: begin_operation(flash, at, command); break;
    case SPM_READABLE | SPM_ENABLE:
        memset(flash->buffer, BLANK, sizeof flash->buffer);
        avr->data[SPMCSR] = 0;
        break;
    default: blame(flash, "SPM without a command in SPMCSR"); break;
    }
    if (!flash->busy)
        avr->data[SPMCSR] &= SPM_BLOCKED;
}

/* simavr's own flash comes after this one and is not asked. */
static int on_ioctl(avr_io_t *io, uint32_t request, void *param)
{
    struct own_flash *flash = (struct own_flash *)((char *)io - offsetof(struct own_flash, io));
    const avr_t *avr = flash->avr;

    (void)param;
    if (request != AVR_IOCTL_FLASH_SPM)
        return -1;
    if (avr->pc < LOADER_START)
        blame(flash, "SPM outside of the loader");
    else if (flash->busy)
        blame(flash, "SPM while a page was erased or written");
    else if (avr->cycle - flash->armed > ARMED_CYCLES)
        blame(flash, "SPM more than four cycles after its command");
    else
        execute(flash, avr->data[SPMCSR] & SPM_COMMAND);
    end_burst(flash->avr);
    return 0;
}

static void write_spmcsr(avr_t *avr, avr_io_addr_t address, uint8_t value, void *param)
{
    struct own_flash *flash = param;
    uint8_t kept = avr->data[address] & SPM_BLOCKED;

    flash->armed = avr->cycle;
    if (!flash->busy)
        avr->data[address] = (value & SPM_COMMAND) | kept;
    end_burst(avr);
}

static void after_reset(avr_io_t *io)
{
    struct own_flash *flash = (struct own_flash *)((char *)io - offsetof(struct own_flash, io));

    flash->busy = false;
    memset(flash->buffer, BLANK, sizeof flash->buffer);
}

void own_flash_attach(struct own_flash *flash, avr_t *avr)
{
    avr_io_addr_t spmcsr = AVR_DATA_TO_IO(SPMCSR);

    flash->avr = avr;
    avr->flash = flash->bytes;
    flash->io = (avr_io_t){.kind = "muster flash", .reset = after_reset, .ioctl = on_ioctl};
    avr_register_io(avr, &flash->io);
    avr->io[spmcsr].w.c = write_spmcsr;
    avr->io[spmcsr].w.param = flash;
    after_reset(&flash->io);
}

/* ---- reading --------------------------------------------------------------------------- */

static bool is_lpm(uint16_t opcode)
{
    return opcode == OPCODE_LPM_R0 || (opcode & 0xFE0E) == 0x9004;
}

static bool is_elpm(uint16_t opcode)
{
    return opcode == OPCODE_ELPM_R0 || (opcode & 0xFE0E) == 0x9006;
}

bool own_flash_watches(const struct own_flash *flash)
{
    return flash->avr->data[SPMCSR] != 0;
}

static void judge_reading(struct own_flash *flash, uint16_t opcode)
{
    const avr_t *avr = flash->avr;
    uint32_t at = z_of(avr) | (is_elpm(opcode) ? (uint32_t)(avr->data[RAMPZ] & 1) << 16 : 0);

    if (!(avr->data[SPMCSR] & SPM_BLOCKED))
        return;
    if (avr->pc < FLASH_RWW_BYTES)
        blame(flash, "code was executed that cannot be read while a page is written");
    else if ((is_lpm(opcode) || is_elpm(opcode)) && at < FLASH_RWW_BYTES)
        blame(flash, "the flash was read while it cannot be");
}

/* The instruction after the command reads fuses where it is an LPM; later ones do not. */
static void read_fuses(struct own_flash *flash, uint16_t opcode)
{
    avr_t *avr = flash->avr;
    uint8_t which = avr->data[REGISTER_ZL] & 3;

    avr->run(avr);
    avr->data[opcode == OPCODE_LPM_R0 ? 0 : opcode >> 4 & 0x1F] = fuses[which];
    avr->data[SPMCSR] &= SPM_BLOCKED;
}

void own_flash_step(struct own_flash *flash)
{
    avr_t *avr = flash->avr;
    uint16_t opcode = (uint16_t)(avr->flash[avr->pc] | avr->flash[avr->pc + 1] << 8);

    avr->run_cycle_count = 1;
    if ((avr->data[SPMCSR] & SPM_FUSES) && is_lpm(opcode)) {
        read_fuses(flash, opcode);
        return;
    }
    judge_reading(flash, opcode);
    if (flash->fault == NULL)
        avr->run(avr);
}
