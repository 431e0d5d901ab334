#include "origin.h"
#include "page_files.h"
#include "view_state.h"

#include <stdio.h>
#include <string.h>

#define ANSWER_MAX 2048
#define PIECE 16384
#define HEADER_MAX 300

/* ---- refusals -------------------------------------------------------------------------- */

/* Returns what the callback is to return. */
static int refuse(struct lws *wsi, unsigned status, const char *words)
{
    uint8_t bytes[LWS_PRE + ANSWER_MAX];
    uint8_t *at = bytes + LWS_PRE;
    uint8_t *end = bytes + sizeof bytes;
    size_t length = strlen(words);

    if (lws_add_http_common_headers(wsi, status, "text/plain; charset=utf-8", length + 1, &at,
                                    end) != 0 ||
        lws_finalize_http_header(wsi, &at, end) != 0 || (size_t)(end - at) < length + 1)
        return -1;
    memcpy(at, words, length);
    at[length] = '\n';
    at += length + 1;
    if (lws_write(wsi, bytes + LWS_PRE, (size_t)(at - bytes - LWS_PRE), LWS_WRITE_HTTP_HEADERS) < 0)
        return -1;
    return 1;
}

static bool take_header(struct lws *wsi, enum lws_token_indexes which, char text[HEADER_MAX])
{
    text[0] = '\0';
    return lws_hdr_copy(wsi, text, HEADER_MAX, which) > 0;
}

static bool is_for_us(struct lws *wsi, char host[HEADER_MAX])
{
    const struct view *view = view_of(wsi);

    return take_header(wsi, WSI_TOKEN_HOST, host) &&
           origin_host_is_ours(host, view->machine, view->address);
}

static int refuse_host(struct lws *wsi)
{
    return refuse(wsi, HTTP_STATUS_FORBIDDEN,
                  "not by this name: use the address that muster printed");
}

/* ---- files ----------------------------------------------------------------------------- */

static bool is(struct lws *wsi, enum lws_token_indexes method)
{
    return lws_hdr_total_length(wsi, method) > 0;
}

static int answer_file(struct lws *wsi, struct http_request *request, const struct page_file *file)
{
    uint8_t bytes[LWS_PRE + ANSWER_MAX];
    uint8_t *at = bytes + LWS_PRE;
    uint8_t *end = bytes + sizeof bytes;

    if (lws_add_http_common_headers(wsi, HTTP_STATUS_OK, file->type, file->count, &at, end) != 0 ||
        lws_finalize_write_http_header(wsi, bytes + LWS_PRE, &at, end) != 0)
        return -1;
    request->bytes = file->bytes;
    request->count = is(wsi, WSI_TOKEN_HEAD_URI) ? 0 : file->count;
    if (request->count == 0)
        return lws_http_transaction_completed(wsi);
    lws_callback_on_writable(wsi);
    return 0;
}

static int answer(struct lws *wsi, struct http_request *request, const char *path)
{
    char host[HEADER_MAX];
    struct page_file file;

    if (!is_for_us(wsi, host))
        refuse_host(wsi);
    else if (!is(wsi, WSI_TOKEN_GET_URI) && !is(wsi, WSI_TOKEN_HEAD_URI))
        refuse(wsi, HTTP_STATUS_METHOD_NOT_ALLOWED, "only GET and HEAD are served");
    else if (page_file(path, &file))
        return answer_file(wsi, request, &file);
    else
        refuse(wsi, HTTP_STATUS_NOT_FOUND, "there is no such page");
    return -1;
}

static int send_piece(struct lws *wsi, struct http_request *request)
{
    uint8_t bytes[LWS_PRE + PIECE];
    size_t count = request->count < PIECE ? request->count : PIECE;
    bool last = count == request->count;

    if (count == 0)
        return 0;
    memcpy(bytes + LWS_PRE, request->bytes, count);
    if (lws_write(wsi, bytes + LWS_PRE, count, last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < 0)
        return -1;
    request->bytes += count;
    request->count -= count;
    if (last)
        return lws_http_transaction_completed(wsi);
    lws_callback_on_writable(wsi);
    return 0;
}

/* ---- WebSockets ------------------------------------------------------------------------ */

/* A page of ours may do all that its viewer may; scripts and programs name no origin, for browsers
 * say it for every page. */
static bool may_look(const char *origin, const char *host, bool page)
{
    return origin[0] == '\0' || origin_is_own(origin, host) ||
           (!page && origin_shows_foxglove(origin));
}

static int judge_upgrade(struct lws *wsi, const char *to)
{
    char host[HEADER_MAX], names[HEADER_MAX], origin[HEADER_MAX];
    bool named = take_header(wsi, WSI_TOKEN_PROTOCOL, names);

    if (!is_for_us(wsi, host))
        return refuse_host(wsi);
    if (strcasecmp(to, "websocket") != 0 || !named)
        return refuse(wsi, HTTP_STATUS_BAD_REQUEST, "a WebSocket with a sub-protocol is served");
    bool said = lws_hdr_total_length(wsi, WSI_TOKEN_ORIGIN) > 0;
    if (said && !take_header(wsi, WSI_TOKEN_ORIGIN, origin))
        return -1;
    if (said && !may_look(origin, host, strstr(names, VIEW_PROTOCOL) != NULL))
        return refuse(wsi, HTTP_STATUS_FORBIDDEN, "not for pages of other places");
    if (view_of(wsi)->viewers >= VIEWERS_MAX)
        return refuse(wsi, HTTP_STATUS_SERVICE_UNAVAILABLE, "too many are looking already");
    return 0;
}

int http_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                  size_t count)
{
    (void)count;
    switch (reason) {
    case LWS_CALLBACK_HTTP: return answer(wsi, user, in);
    case LWS_CALLBACK_HTTP_WRITEABLE: return send_piece(wsi, user);
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE: return judge_upgrade(wsi, in);
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: return -1; /* to "http" by WebSocket */
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED: view_woken(view_of(wsi)); return 0;
    default: return 0;
    }
}
