#define PROTOCOL dtrack_protocol
#include "protocol.h"
