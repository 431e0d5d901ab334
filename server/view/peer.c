/* peer.c: what all that look have in common. */
#include "view_state.h"

#include <string.h>

void peer_enter(struct view *view, struct peer **list, struct peer *peer, struct lws *wsi)
{
    peer->wsi = wsi;
    peer->next = *list;
    *list = peer;
    view->viewers++;
    view->looked_at = true;
    peer_ask(peer);
}

/* One whose handshake failed never entered. */
void peer_leave(struct view *view, struct peer **list, struct peer *peer)
{
    while (*list != NULL && *list != peer)
        list = &(*list)->next;
    if (*list == NULL)
        return;
    *list = peer->next;
    view->viewers--;
}

void peer_ask(struct peer *peer)
{
    if (!peer->asked)
        lws_set_timeout(peer->wsi, PENDING_TIMEOUT_USER_OK, STUCK_S);
    peer->asked = true;
    lws_callback_on_writable(peer->wsi);
}

void peer_asked(struct peer *peer)
{
    peer->asked = false;
    lws_set_timeout(peer->wsi, NO_PENDING_TIMEOUT, 0);
}

void peers_ask(struct peer *list)
{
    for (; list != NULL; list = list->next)
        peer_ask(list);
}

enum heard peer_hear(struct peer *peer, const char *bytes, size_t count)
{
    bool last = lws_is_final_fragment(peer->wsi) && lws_remaining_packet_payload(peer->wsi) == 0;

    if (lws_frame_is_binary(peer->wsi))
        return HEARD_BINARY;
    if (lws_is_first_fragment(peer->wsi))
        peer->count = 0;
    if (count > sizeof peer->text - peer->count)
        return HEARD_TOO_MUCH;
    memcpy(peer->text + peer->count, bytes, count);
    peer->count += count;
    return last ? HEARD_TEXT : HEARD_PART;
}

static bool write_buffer(struct view *view, struct peer *peer, size_t count,
                         enum lws_write_protocol kind)
{
    return lws_write(peer->wsi, view->buffer + LWS_PRE, count, kind) >= 0;
}

bool peer_send_text(struct view *view, struct peer *peer, const char *text)
{
    size_t count = strlen(text);

    if (!view_buffer(view, count))
        return false;
    memcpy(view->buffer + LWS_PRE, text, count);
    return write_buffer(view, peer, count, LWS_WRITE_TEXT);
}

bool peer_send(struct view *view, struct peer *peer, size_t count)
{
    return write_buffer(view, peer, count, LWS_WRITE_BINARY);
}

int peer_hang_up(struct peer *peer, enum lws_close_status why)
{
    lws_close_reason(peer->wsi, why, NULL, 0);
    return -1;
}
