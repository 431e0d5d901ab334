/* crc16.h (ATmega128): one byte of the link's checksum (frame.h), by avr-libc. The twin of
 * common/host/crc16.h. */
#ifndef CRC16_H
#define CRC16_H

#include <util/crc16.h>

#define crc16_update _crc_ccitt_update

#endif
