#define _GNU_SOURCE /* gettid, accept4 */

#include "view_state.h"

#include <errno.h>
#include <fcntl.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

/* From one look for news to the next, at the least. Four are just more than a frame of Foxglove's
 * viewers. */
#define LOOK_US 8400

/* For viewers that have not got all when it is over. */
#define END_US 1000000

#define HANDSHAKE_S 5

/* Connections at a time, whatever they are, with what libwebsockets needs itself. */
#define CONNECTIONS_MAX (VIEWERS_MAX + 32)

/* So that it disturbs nobody, whatever priority the run has. */
#define NICE 10

static int listener_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user,
                             void *in, size_t count);
static int timer_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                          size_t count);

#define SOCKET(of, hears, session)                                                                 \
    {                                                                                              \
        .name = of, .callback = hears, .per_session_data_size = sizeof(session),                   \
        .rx_buffer_size = 4096, .tx_packet_size = 1 << 20                                          \
    }

/* The first one is for those who name none. */
static const struct lws_protocols protocols[] = {
    {.name = "http",
     .callback = http_callback,
     .per_session_data_size = sizeof(struct http_request)},
    SOCKET(VIEW_PROTOCOL, viewer_callback, struct viewer),
    SOCKET(FOXGLOVE_PROTOCOL, foxglove_callback, struct foxglove_viewer),
    SOCKET(FOXGLOVE_PROTOCOL_OLD, foxglove_callback, struct foxglove_viewer),
    {.name = "listener", .callback = listener_callback},
    {.name = "timer", .callback = timer_callback},
    {0},
};

/* What every answer says to browsers: this page is made of its own files, and of nothing else. */
static const struct lws_protocol_vhost_options headers[] = {
    {&headers[1], NULL, "content-security-policy:",
     "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
     "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {&headers[2], NULL, "x-content-type-options:", "nosniff"},
    {&headers[3], NULL, "referrer-policy:", "no-referrer"},
    {NULL, NULL, "cache-control:", "no-store"},
};

struct view *view_of(struct lws *wsi)
{
    return lws_context_user(lws_get_context(wsi));
}

bool view_buffer(struct view *view, size_t bytes)
{
    if (bytes <= view->buffer_room)
        return true;
    uint8_t *buffer = realloc(view->buffer, LWS_PRE + bytes);
    if (buffer == NULL)
        return false;
    view->buffer = buffer;
    view->buffer_room = bytes;
    return true;
}

/* ---- connections ----------------------------------------------------------------------- */

/* A connection that cannot be had would be there again at once: it is taken and closed. */
static void turn_away(struct view *view)
{
    close(view->spare);
    int fd = accept4(view->listener, NULL, NULL, SOCK_CLOEXEC);
    if (fd >= 0)
        close(fd);
    view->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
}

static void take_connection(struct view *view, struct lws_vhost *host)
{
    int on = 1;
    int fd = accept4(view->listener, NULL, NULL, SOCK_NONBLOCK | SOCK_CLOEXEC);

    if (fd < 0) {
        if (errno == EMFILE || errno == ENFILE)
            turn_away(view);
        return;
    }
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    lws_adopt_socket_vhost(host, fd); /* which closes what it does not want */
}

static int listener_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user,
                             void *in, size_t count)
{
    (void)user;
    (void)in;
    (void)count;
    if (reason == LWS_CALLBACK_RAW_RX_FILE)
        take_connection(view_of(wsi), lws_get_vhost(wsi));
    return reason == LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION;
}

/* ---- news ------------------------------------------------------------------------------ */

/* The run's thread may come 10,000 times a second: it wakes this one, which then looks every
 * LOOK_US until there is nothing new. */
void view_wake(struct view *view)
{
    view->news++;
    if (view->context != NULL && !atomic_exchange(&view->awake, true))
        lws_cancel_service(view->context);
}

static bool tell_news(struct view *view)
{
    unsigned news = view->news;
    bool more = foxglove_viewers_tell(view);

    if (news == view->seen)
        return more;
    view->seen = news;
    viewers_tell(view);
    return true;
}

/* What comes after it fell asleep wakes it; what came just before is looked for here. */
static void look(struct view *view)
{
    const struct itimerspec in_a_while = {.it_value.tv_nsec = LOOK_US * 1000};

    if (!tell_news(view)) {
        view->awake = false;
        if (!tell_news(view))
            return;
        view->awake = true;
    }
    timerfd_settime(view->timer, 0, &in_a_while, NULL);
}

/* Not one of libwebsockets' own, which it polls for without a rest in their last millisecond. */
static int timer_callback(struct lws *wsi, enum lws_callback_reasons reason, void *user, void *in,
                          size_t count)
{
    uint64_t times;
    struct view *view = view_of(wsi);

    (void)user;
    (void)in;
    (void)count;
    if (reason == LWS_CALLBACK_RAW_RX_FILE && read(view->timer, &times, sizeof times) > 0)
        look(view);
    return reason == LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION;
}

/* libwebsockets goes on to wait for events after a timer's: it is to come back. */
static void end_without_them(lws_sorted_usec_list_t *timer)
{
    struct view *view = lws_container_of(timer, struct view, end);

    view->late = true;
    lws_cancel_service(view->context);
}

void view_woken(struct view *view)
{
    view->awake = true;
    look(view);
    if (view->over && !view->late)
        lws_sul_schedule(view->context, 0, &view->end, end_without_them, END_US);
}

/* ---- the thread ------------------------------------------------------------------------ */

static void *serve(void *context)
{
    struct view *view = context;

    sched_setscheduler(0, SCHED_OTHER, &(struct sched_param){0});
    setpriority(PRIO_PROCESS, (id_t)gettid(), NICE);
    while (!view->over || (view->viewers > 0 && !view->late))
        lws_service(view->context, 0);
    return NULL;
}

/* Signals are for the run's thread: this one is begun without any. */
static bool start(struct view *view)
{
    sigset_t all, before;

    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    view->running = pthread_create(&view->thread, NULL, serve, view) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return view->running;
}

/* libwebsockets has SIGPIPE ignored by the whole process; that is for the process to say. */
static struct lws_context *create(struct view *view)
{
    struct lws_context_creation_info info = {
        .port = CONTEXT_PORT_NO_LISTEN_SERVER,
        .protocols = protocols,
        .headers = headers,
        .server_string = "muster",
        .gid = (gid_t)-1,
        .uid = (uid_t)-1,
        .options = LWS_SERVER_OPTION_SKIP_SERVER_CANONICAL_NAME,
        .fd_limit_per_thread = CONNECTIONS_MAX,
        .max_http_header_pool = CONNECTIONS_MAX,
        .timeout_secs = HANDSHAKE_S,
        .keepalive_timeout = HANDSHAKE_S,
        .user = view,
    };
    struct sigaction before;

    lws_set_log_level(0, NULL);
    sigaction(SIGPIPE, NULL, &before);
    struct lws_context *made = lws_create_context(&info);
    sigaction(SIGPIPE, &before, NULL);
    return made;
}

/* Has libwebsockets wait for it too; it closes what it is given. */
static bool adopt(struct view *view, int descriptor, const char *protocol)
{
    lws_sock_file_fd_type fd = {.filefd = fcntl(descriptor, F_DUPFD_CLOEXEC, 0)};
    struct lws_vhost *host = lws_get_vhost_by_name(view->context, "default");

    return fd.filefd >= 0 &&
           lws_adopt_descriptor_vhost(host, LWS_ADOPT_RAW_FILE_DESC, fd, protocol, NULL) != NULL;
}

bool view_thread_begin(struct view *view, char *error, size_t room)
{
    view->spare = open("/dev/null", O_RDONLY | O_CLOEXEC);
    view->timer = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    view->context = create(view);
    if (view->context != NULL && adopt(view, view->listener, "listener") &&
        adopt(view, view->timer, "timer") && start(view))
        return true;
    snprintf(error, room, "a view could not begin: %s", strerror(errno));
    return false;
}

void view_thread_end(struct view *view)
{
    if (view->running) {
        view->over = true;
        view->news++;
        lws_cancel_service(view->context);
        pthread_join(view->thread, NULL);
    }
    if (view->context != NULL)
        lws_context_destroy(view->context);
}
