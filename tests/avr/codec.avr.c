/* Sends the known answer of every message; then answers each message with the same one, read and
 * written again, and what is no message with REFUSED. */
#include "codec.h"
#include "message_vectors.h"
#include "report.h"

#include <avr/interrupt.h>

static void send(const struct message *message)
{
    uint8_t payload[FRAME_PAYLOAD_MAX];
    uint8_t frame[FRAME_BYTES_MAX];

    report(frame, frame_encode(frame, payload, message_write(payload, message)));
}

static void answer(struct frame_decoder *decoder, enum frame_event event)
{
    struct message message;

    if (event == FRAME_PENDING)
        return;
    if (event == FRAME_READY && message_read(&message, decoder->payload, decoder->length))
        send(&message);
    else
        report_byte(REFUSED);
}

int main(void)
{
    struct frame_decoder decoder;
    const uint8_t *bytes;

    usart_init();
    sei();
    for (uint8_t i = 0; i < MESSAGE_VECTORS; i++)
        send(&message_vectors[i].message);
    report_byte(REPORT_END);

    frame_decoder_init(&decoder);
    for (;;) {
        if (usart_peek(usart_mark(), &bytes) > 0) {
            answer(&decoder, frame_decode(&decoder, *bytes));
            usart_drop(1);
        }
    }
}
