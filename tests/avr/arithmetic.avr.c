/* Sends the hash of every block of the portion that its EEPROM names. */
#include "arithmetic.h"
#include "report.h"

#include <avr/eeprom.h>
#include <avr/interrupt.h>
#include <avr/sleep.h>

int main(void)
{
    uint8_t function = eeprom_read_byte((const uint8_t *)EEPROM_FUNCTION);
    uint8_t portion = eeprom_read_byte((const uint8_t *)EEPROM_PORTION);

    usart_init();
    sei();
    for (uint8_t i = 0; i < BLOCKS_PER_PORTION; i++) {
        uint32_t hash = arithmetic_hash(function, (uint8_t)(portion * BLOCKS_PER_PORTION + i));

        report((const uint8_t *)&hash, sizeof hash);
    }
    report_byte(REPORT_END);
    for (;;)
        sleep_mode();
}
