/* Says what the last reset was, and how many there were. After the first one it drives the motors
 * and hangs. */
#include "motors.h"
#include "report.h"
#include "watchdog.h"

#include <avr/interrupt.h>
#include <avr/sleep.h>

int main(void)
{
    uint8_t cause;

    watchdog_start();
    cause = watchdog_reset_cause();
    motors_init();
    usart_init();
    sei();
    report_byte(cause);
    report_byte((uint8_t)watchdog_resets());
    if (cause & _BV(PORF)) {
        cli();
        motors_hand_over(1000, -1000);
        motors_latch();
        sei();
        for (;;)
            ;
    }
    report_byte(REPORT_END);
    for (;;) {
        watchdog_kick();
        sleep_mode();
    }
}
