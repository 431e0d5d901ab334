#define PROTOCOL qtm_protocol
#include "protocol.h"
