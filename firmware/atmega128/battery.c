#include "battery.h"

#include "pins.h"

#include <avr/io.h>

#define FULL_SCALE_MV ((uint32_t)ADC_REFERENCE_MV * BATTERY_DIVIDER)

static uint16_t millivolts;

void battery_init(void)
{
    ADMUX = _BV(REFS0) | BATTERY_CHANNEL; /* against AVCC */
    /* F_CPU / 128: the converter wants 50 to 200 kHz for its 10 bits. */
    ADCSRA = _BV(ADEN) | _BV(ADSC) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
}

uint16_t battery_poll(void)
{
    if (!(ADCSRA & _BV(ADSC))) {
        millivolts = (uint16_t)(ADC * FULL_SCALE_MV / 1024);
        ADCSRA |= _BV(ADSC);
    }
    return millivolts;
}
