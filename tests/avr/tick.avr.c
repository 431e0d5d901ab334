/* Sets the motors anew at every tick, to (k, -k) at the kth; at every third it takes longer than
 * ACTUATION_MS to do so. Says END after TICKS of them. */
#include "tick.h"
#include "limits.h"
#include "motors.h"
#include "report.h"
#include "ticks.h"

#include <avr/interrupt.h>
#include <avr/sleep.h>
#include <util/delay.h>

static void act(int16_t k)
{
    if (k % 3 == 0)
        _delay_ms(ACTUATION_MS + 2);
    motors_hand_over(k, -k);
    tick_acted();
    tick_done();
}

int main(void)
{
    int16_t k = 0;
    tick_start();
    motors_init();
    usart_init();
    sei();
    while (k < TICKS)
        if (tick_pending) {
            tick_take();
            act(++k);
        }
    report_byte(REPORT_END);
    for (;;)
        sleep_mode();
}
