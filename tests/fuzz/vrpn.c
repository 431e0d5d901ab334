#define PROTOCOL vrpn_protocol
#include "protocol.h"
