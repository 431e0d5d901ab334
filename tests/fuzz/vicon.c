#define PROTOCOL vicon_protocol
#include "protocol.h"
