/* orders.h: what the programs of these tests do when they are sent one byte. */
#ifndef ORDERS_H
#define ORDERS_H

enum { ORDER_HANG = 'h', ORDER_CALL = 'c' };

#endif
