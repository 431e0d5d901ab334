/* What the host's tools read from an image: absolute symbols, which take no room in it. */
#include "message.h"

#define DEFINE(name, value) __asm__ volatile(".global " #name "\n\t.set " #name ", %0" ::"i"(value))

__attribute__((used)) static void symbols(void)
{
    DEFINE(muster_f_cpu, F_CPU);
    DEFINE(muster_baud, BAUD);
    DEFINE(muster_protocol, PROTOCOL_VERSION);
}
