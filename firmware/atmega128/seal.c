#include "flash_map.h"

/* Blank until cmake/seal.sh has seen the linked program. */
__attribute__((section(".seal"))) const struct seal program_seal = {0xFFFF, 0xFFFF, 0xFFFFFFFF};
