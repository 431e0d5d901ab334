/* awake.h: processors that do not sleep between two events.
 *
 * To wake one takes as long as to write to twenty robots: 50 us and more, on virtual machines 100.
 * Linux keeps them awake for as long as somebody holds /dev/cpu_dma_latency open with a 0 in it
 * (Documentation/power/pm_qos_interface.rst), at the price of power. */
#ifndef AWAKE_H
#define AWAKE_H

/* Keeps them awake until the descriptor is closed. -1 with errno where that is not allowed: all
 * works as well, a little later. */
int awake_hold(void);

#endif
