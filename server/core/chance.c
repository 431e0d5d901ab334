#include "chance.h"

/* 2^64 over the golden ratio: keeps the kinds' seeds far apart. */
#define KIND_STEP 0x9E3779B97F4A7C15u

uint64_t chance_scramble(uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

uint64_t chance_draw(uint64_t seed, enum chance_kind kind, uint64_t name)
{
    return chance_scramble(chance_scramble(seed + (kind + UINT64_C(1)) * KIND_STEP) ^ name);
}

double chance_unit(uint64_t draw)
{
    return (double)(draw >> 11) * 0x1p-53;
}
