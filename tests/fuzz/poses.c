#define PROTOCOL poses_protocol
#include "protocol.h"
