#include "charge.h"

/* Counts a tick below a threshold; true when there have been enough in a row. */
static bool stays_below(uint8_t *ticks, uint16_t millivolts, uint16_t threshold)
{
    if (millivolts >= threshold)
        *ticks = 0;
    else if (*ticks < CHARGE_TICKS)
        ++*ticks;
    return *ticks == CHARGE_TICKS;
}

void charge_watch(struct charge *charge, uint16_t millivolts, const struct parameters *parameters)
{
    uint16_t warning = parameters->value[PARAMETER_BATTERY_WARNING];

    if (charge->spent && charge->spent_for < CHARGE_HANDOVER_TICKS)
        charge->spent_for++;
    if (millivolts == 0)
        return;
    if (stays_below(&charge->low, millivolts, warning))
        charge->warns = true;
    else if (millivolts >= warning + CHARGE_HYSTERESIS_MV || warning == 0)
        charge->warns = false;
    if (stays_below(&charge->critical, millivolts, parameters->value[PARAMETER_BATTERY_CRITICAL]))
        charge->spent = true;
}
