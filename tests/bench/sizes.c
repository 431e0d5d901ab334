/* sizes.c: what images take of the chip's memories, from their program headers. */
#include "benchmarks.h"
#include "flash_map.h"
#include "results.h"

#include <err.h>
#include <fcntl.h>
#include <gelf.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The linker's way of putting all memories into one space. */
#define RAM_BASE 0x800000u
#define EEPROM_BASE 0x810000u

struct image_size {
    uint64_t flash; /* bytes of code, tables and initial values */
    uint64_t ram;   /* bytes of variables */
};

static void add(struct image_size *size, const GElf_Phdr *part)
{
    /* The seal is there for the boot loader. */
    if (part->p_type != PT_LOAD || part->p_vaddr >= EEPROM_BASE || part->p_paddr == SEAL_AT)
        return;
    size->flash += part->p_filesz;
    if (part->p_vaddr >= RAM_BASE)
        size->ram += part->p_memsz;
}

static struct image_size size_of(const char *path)
{
    struct image_size size = {0, 0};
    size_t parts;
    int file = open(path, O_RDONLY | O_CLOEXEC);

    elf_version(EV_CURRENT);
    Elf *elf = file < 0 ? NULL : elf_begin(file, ELF_C_READ, NULL);
    if (elf == NULL || elf_getphdrnum(elf, &parts) != 0)
        errx(EXIT_FAILURE, "%s cannot be read", path);
    for (size_t i = 0; i < parts; i++) {
        GElf_Phdr part;

        if (gelf_getphdr(elf, (int)i, &part) != NULL)
            add(&size, &part);
    }
    elf_end(elf);
    close(file);
    return size;
}

void measure_sizes(void)
{
    struct image_size robot = size_of(BENCH_FIRMWARE);
    uint64_t with = size_of(BENCH_IMAGES "/with_law.elf").flash;
    uint64_t without = size_of(BENCH_IMAGES "/without_law.elf").flash;

    figure_set("flash_bytes", (double)robot.flash);
    figure_set("ram_static_bytes", (double)robot.ram);
    figure_set("fl_law_flash_bytes", (double)(with - without));
}
