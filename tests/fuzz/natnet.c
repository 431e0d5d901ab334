#define PROTOCOL natnet_protocol
#include "protocol.h"
