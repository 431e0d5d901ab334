#include "upload.h"

void upload_begin(struct upload *upload)
{
    upload->acknowledged = 0;
    upload->next = 0;
    upload->end = 0;
    upload->waited = 0;
    upload->taken = false;
    upload_add(upload, (struct upload_item){.kind = UPLOAD_MISSION});
}

uint8_t upload_room(const struct upload *upload)
{
    return UINT8_MAX - (uint8_t)(upload->end - upload->acknowledged);
}

void upload_add(struct upload *upload, struct upload_item item)
{
    upload->item[upload->end++] = item;
}

bool upload_acknowledge(struct upload *upload, uint8_t expected)
{
    uint8_t progress = expected - upload->acknowledged;

    if (progress > (uint8_t)(upload->end - upload->acknowledged))
        return false;
    if (progress > 0) {
        upload->waited = 0;
        upload->taken = true;
    }
    if (progress > (uint8_t)(upload->next - upload->acknowledged))
        upload->next = expected;
    upload->acknowledged = expected;
    return true;
}

void upload_wait(struct upload *upload)
{
    if (upload->next == upload->acknowledged) {
        upload->waited = 0;
    } else if (++upload->waited >= UPLOAD_PATIENCE_TICKS) {
        upload->waited = 0;
        upload->next = upload->acknowledged;
    }
}

bool upload_next(struct upload *upload, struct upload_item *item, uint8_t *sequence)
{
    if (upload->next == upload->end ||
        (uint8_t)(upload->next - upload->acknowledged) >= UPLOAD_WINDOW)
        return false;
    *sequence = upload->next;
    *item = upload->item[upload->next++];
    return true;
}

bool upload_mentions(const struct upload *upload, uint8_t formation)
{
    for (uint8_t i = upload->acknowledged; i != upload->end; i++)
        if (upload->item[i].kind == UPLOAD_VERTICES && upload->item[i].formation == formation)
            return true;
    return false;
}

bool upload_done(const struct upload *upload)
{
    return upload->acknowledged == upload->end;
}
