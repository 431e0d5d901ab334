#include "avr_image.h"

#include "atmega128.h"

#include <fcntl.h>
#include <gelf.h>
#include <libelf.h>
#include <sim_avr.h>
#include <sim_core.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The linker's way of putting all memories into one space: flash from 0, RAM from here. */
#define RAM_BASE 0x800000u

/* The opcode that makes simavr stop instead of running off the end of the flash. */
static const uint8_t flash_stop[4] = {AVR_OVERFLOW_OPCODE & 0xFF, AVR_OVERFLOW_OPCODE >> 8};

struct wanted_symbol {
    const char *name;
    uint32_t value;
    bool missing;
};

static bool read_program(Elf *elf, uint8_t *flash)
{
    size_t count;

    if (elf_getphdrnum(elf, &count) != 0)
        return false;
    for (size_t i = 0; i < count; i++) {
        GElf_Phdr header;

        if (gelf_getphdr(elf, (int)i, &header) == NULL)
            return false;
        if (header.p_type != PT_LOAD || header.p_paddr >= RAM_BASE || header.p_filesz == 0)
            continue;
        if (header.p_paddr > FLASH_BYTES || header.p_filesz > FLASH_BYTES - header.p_paddr)
            return false;
        Elf_Data *data =
            elf_getdata_rawchunk(elf, (int64_t)header.p_offset, header.p_filesz, ELF_T_BYTE);
        if (data == NULL || data->d_size < header.p_filesz)
            return false;
        memcpy(flash + header.p_paddr, data->d_buf, header.p_filesz);
    }
    return true;
}

static void match_symbol(const char *name, uint32_t value, struct wanted_symbol *wanted,
                         size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(name, wanted[i].name) == 0) {
            wanted[i].value = value;
            wanted[i].missing = false;
        }
    }
}

static void read_symbols(Elf *elf, struct wanted_symbol *wanted, size_t count)
{
    Elf_Scn *section = NULL;

    while ((section = elf_nextscn(elf, section)) != NULL) {
        GElf_Shdr header;
        Elf_Data *data;
        GElf_Sym symbol;

        if (gelf_getshdr(section, &header) == NULL || header.sh_type != SHT_SYMTAB)
            continue;
        data = elf_getdata(section, NULL);
        for (int i = 0; data != NULL && gelf_getsym(data, i, &symbol) != NULL; i++) {
            const char *name = elf_strptr(elf, header.sh_link, symbol.st_name);

            if (name != NULL)
                match_symbol(name, (uint32_t)symbol.st_value, wanted, count);
        }
    }
}

/* A variable of two bytes, or the first address behind the variables. */
static bool in_ram(uint32_t address)
{
    return address >= RAM_BASE + SRAM_START && address < RAM_BASE + SRAM_END;
}

/* NULL when all went well, else what is wrong with the file. */
static const char *take_symbols(Elf *elf, struct avr_image *image)
{
    enum { F_CPU, BAUD, PROTOCOL, DATA_END, TICK_CYCLES_MAX, SYMBOLS };
    struct wanted_symbol symbol[SYMBOLS] = {
        [F_CPU] = {.name = "muster_f_cpu", .missing = true},
        [BAUD] = {.name = "muster_baud", .missing = true},
        [PROTOCOL] = {.name = "muster_protocol", .missing = true},
        [DATA_END] = {.name = "_end", .missing = true},
        [TICK_CYCLES_MAX] = {.name = "tick_cycles_max"}, /* only where there is a tick */
    };

    read_symbols(elf, symbol, SYMBOLS);
    for (int i = 0; i < SYMBOLS; i++)
        if (symbol[i].missing)
            return "is not Muster's: its symbols muster_f_cpu, muster_baud, muster_protocol are "
                   "missing";
    if (symbol[F_CPU].value == 0 || symbol[BAUD].value == 0)
        return "was built for a clock or a baud rate of 0";
    if (!in_ram(symbol[DATA_END].value))
        return "needs more RAM than an ATmega128 has";

    image->f_cpu = symbol[F_CPU].value;
    image->baud = symbol[BAUD].value;
    image->protocol = symbol[PROTOCOL].value;
    image->data_end = (uint16_t)(symbol[DATA_END].value - RAM_BASE);
    if (in_ram(symbol[TICK_CYCLES_MAX].value))
        image->tick_cycles_max = (uint16_t)(symbol[TICK_CYCLES_MAX].value - RAM_BASE);
    return NULL;
}

static const char *read_elf(Elf *elf, struct avr_image *image)
{
    GElf_Ehdr header;

    if (elf == NULL || elf_kind(elf) != ELF_K_ELF || gelf_getehdr(elf, &header) == NULL)
        return "is no ELF file";
    if (header.e_machine != EM_AVR)
        return "is not for an AVR";
    if (!read_program(elf, image->flash))
        return "is cut short or does not fit into the flash of an ATmega128";
    return take_symbols(elf, image);
}

static struct avr_image *new_image(void)
{
    struct avr_image *image = calloc(1, sizeof *image);

    if (image == NULL)
        return NULL;
    image->flash = malloc(FLASH_BYTES + sizeof flash_stop);
    if (image->flash == NULL) {
        free(image);
        return NULL;
    }
    memset(image->flash, 0xFF, FLASH_BYTES);
    memcpy(image->flash + FLASH_BYTES, flash_stop, sizeof flash_stop);
    return image;
}

struct avr_image *avr_image_open(const char *path, char *error, size_t room)
{
    struct avr_image *image = NULL;
    const char *wrong = "cannot be read";
    int file = open(path, O_RDONLY | O_CLOEXEC);

    if (file >= 0 && (image = new_image()) == NULL) {
        wrong = "does not fit into memory";
    } else if (file >= 0) {
        elf_version(EV_CURRENT);
        Elf *elf = elf_begin(file, ELF_C_READ, NULL);
        wrong = read_elf(elf, image);
        elf_end(elf);
    }
    if (file >= 0)
        close(file);
    if (wrong == NULL)
        return image;

    snprintf(error, room, "%s: %s", path, wrong);
    if (image != NULL)
        avr_image_close(image);
    return NULL;
}

uint32_t avr_image_baud(const struct avr_image *image)
{
    return image->baud;
}

void avr_image_close(struct avr_image *image)
{
    free(image->flash);
    free(image);
}
