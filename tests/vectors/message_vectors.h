/* message_vectors.h: one known answer per message, for the host, for the chip and for
 * docs/PROTOCOL.md. The frames were made from that document, by another program. */
#ifndef MESSAGE_VECTORS_H
#define MESSAGE_VECTORS_H

#include "message.h"
#include "parameter_table.h"

struct message_vector {
    struct message message;
    uint8_t frame_length;
    uint8_t frame[36];
};

static const struct message_vector message_vectors[] = {
    {
        .message = {.type = MESSAGE_POSE,
                    .pose = {.time = 123456, .pose = {{-8000, 4000}, 0x8000}}},
        .frame_length = 17,
        .frame = {0x05, 0x01, 0x40, 0xE2, 0x01, 0x06, 0xC0, 0xE0, 0xFF, 0xA0, 0x0F, 0x01, 0x04,
                  0x80, 0xDC, 0xF5, 0x00},
    },
    {
        .message = {.type = MESSAGE_KEEPALIVE, .keepalive = {.time = -500}},
        .frame_length = 9,
        .frame = {0x08, 0x02, 0x0C, 0xFE, 0xFF, 0xFF, 0xA3, 0xDD, 0x00},
    },
    {
        .message = {.type = MESSAGE_MISSION,
                    .mission = {.sequence = 0,
                                .version = 1,
                                .mission = 7,
                                .candidate = true,
                                .law = LAW_FL,
                                .allocation = ALLOCATION_CPA,
                                .k = 256,
                                .k_theta = 768,
                                .v_max = 16000,
                                .omega_max = 10240,
                                .track = 320,
                                .wheel_max = 17600,
                                .latency = 5}},
        .frame_length = 24,
        .frame = {0x02, 0x03, 0x04, 0x01, 0x07, 0x01, 0x01, 0x01, 0x02, 0x01, 0x04, 0x03,
                  0x80, 0x3E, 0x09, 0x28, 0x40, 0x01, 0xC0, 0x44, 0x05, 0xA0, 0x9F, 0x00},
    },
    {
        .message =
            {.type = MESSAGE_VERTICES,
             .vertices = {.sequence = 1,
                          .formation = 1,
                          .scale = 0,
                          .total = 4,
                          .first = 0,
                          .count = 4,
                          .vertex = {{0, 0}, {8000, 0xD555}, {8000, 0x2AAB}, {8000, 0x8000}}}},
        .frame_length = 33,
        .frame = {0x04, 0x04, 0x01, 0x01, 0x02, 0x04, 0x01, 0x01, 0x02, 0x04, 0x01,
                  0x01, 0x01, 0x01, 0x03, 0x40, 0x1F, 0x05, 0x55, 0xD5, 0x40, 0x1F,
                  0x05, 0xAB, 0x2A, 0x40, 0x1F, 0x01, 0x04, 0x80, 0x68, 0xCC, 0x00},
    },
    {
        .message = {.type = MESSAGE_KNOT,
                    .knot = {.sequence = 2,
                             .knot = {.time = 1000,
                                      .pose = {{-6000, 123}, 0x8123},
                                      .v = 6000,
                                      .omega = -205}}},
        .frame_length = 22,
        .frame = {0x05, 0x05, 0x02, 0xE8, 0x03, 0x01, 0x05, 0x90, 0xE8, 0xFF, 0x7B,
                  0x01, 0x09, 0x23, 0x81, 0x70, 0x17, 0x33, 0xFF, 0xA0, 0x92, 0x00},
    },
    {
        .message = {.type = MESSAGE_ASSIGN, .assign = {.sequence = 3, .vertex = 258}},
        .frame_length = 8,
        .frame = {0x07, 0x06, 0x03, 0x02, 0x01, 0xE6, 0x85, 0x00},
    },
    {
        .message = {.type = MESSAGE_ESTOP},
        .frame_length = 5,
        .frame = {0x04, 0x07, 0x38, 0x7B, 0x00},
    },
    {
        .message =
            {.type = MESSAGE_ASK,
             .ask = {.tag = 9, .action = PARAMETER_SET, .index = PARAMETER_TRACK, .value = 330}},
        .frame_length = 12,
        .frame = {0x07, 0x08, 0x09, 0x01, 0x05, 0x4A, 0x01, 0x01, 0x03, 0xB3, 0xA2, 0x00},
    },
    {
        .message = {.type = MESSAGE_DRIVE,
                    .drive = {.left = 4000, .right = -16383, .corrected = true}},
        .frame_length = 10,
        .frame = {0x09, 0x09, 0xA0, 0x0F, 0x01, 0xC0, 0x01, 0xC1, 0xF4, 0x00},
    },
    {
        .message = {.type = MESSAGE_LOADER},
        .frame_length = 5,
        .frame = {0x04, 0x0A, 0xDD, 0xA0, 0x00},
    },
    {
        .message = {.type = MESSAGE_BEACON,
                    .beacon = {.id = 2,
                               .time = 0xE240,
                               .pose = {{8000, -4000}, 0x4000},
                               .v = 6000,
                               .omega = -205,
                               .role = ROLE_LEADER,
                               .candidate = true,
                               .fault = false,
                               .to_all = true,
                               .term = 3,
                               .leader_age = 0,
                               .vertex = 1,
                               .formation = 1}},
        .frame_length = 28,
        .frame = {0x03, 0x10, 0x02, 0x05, 0x40, 0xE2, 0x40, 0x1F, 0x04, 0x60,
                  0xF0, 0xFF, 0x08, 0x40, 0x70, 0x17, 0x33, 0xFF, 0x15, 0x03,
                  0x01, 0x02, 0x01, 0x04, 0x01, 0x7A, 0xCE, 0x00},
    },
    {
        .message = {.type = MESSAGE_STATUS,
                    .status = {.id = 2,
                               .version = 1,
                               .mission = 7,
                               .expected = 4,
                               .state = 3,
                               .faults = FAULT_POSE_STALE | FAULT_STALL,
                               .reset_cause = 1,
                               .battery = 7400,
                               .bad_frames = 0,
                               .overruns = 513,
                               .tick_cycles = 953,
                               .stack_free = 927,
                               .vertices_max = 128}},
        .frame_length = 25,
        .frame = {0x03, 0x11, 0x02, 0x09, 0x01, 0x07, 0x04, 0x03, 0x0A, 0x01, 0xE8, 0x1C, 0x01,
                  0x08, 0x01, 0x02, 0xB9, 0x03, 0x9F, 0x03, 0x80, 0x03, 0x13, 0x23, 0x00},
    },
    {
        .message = {.type = MESSAGE_ANSWER,
                    .answer = {.id = 2,
                               .tag = 9,
                               .result = PARAMETER_DONE,
                               .index = PARAMETER_IMAGE,
                               .value = 0xCBF43926}},
        .frame_length = 14,
        .frame = {0x03, 0x12, 0x02, 0x02, 0x09, 0x08, 0x80, 0x26, 0x39, 0xF4, 0xCB, 0xC3, 0xFB,
                  0x00},
    },
};

#define MESSAGE_VECTORS (sizeof message_vectors / sizeof message_vectors[0])

#endif
