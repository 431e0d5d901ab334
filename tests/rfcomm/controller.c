/* controller N: N classic Bluetooth controllers, hci0 to hci<N-1>, that hear one another.
 *
 * The kernel takes them from /dev/vhci. They do what connections and their data need of them
 * (Bluetooth Core 2.0, volume 2, part E), a robot's module and a dongle alike: hciI has the address
 * 02:00:00:00:00:0I and is paged, once its host lets it scan, by whoever calls that.
 *
 * Lines on stdin: `cut I`, it is out of range, and its links die of it; `mend I`, it is back;
 * `unplug I`, its adapter is pulled out. Ends with its stdin. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <bluetooth/bluetooth.h>
#include <bluetooth/hci.h>

#define CONTROLLERS_MAX 10 /* one digit each */
#define CONNECTIONS_MAX 64
#define NOBODY (-1)
#define TICK_MS 20

#define PAGE_TIMEOUT_MS 5120
/* Unless the host that has called says otherwise. */
#define SUPERVISION_TIMEOUT_MS 20000

#define OPCODE(ogf, ocf) ((uint16_t)((ogf) << 10 | (ocf)))

struct controller {
    int vhci;  /* -1: unplugged */
    bool away; /* out of range */
    bool scanning;
};

enum stage {
    FREE,
    PAGING, /* nobody answers, yet */
    ASKING, /* the host that is called has not decided */
    UP,
    DYING, /* out of range: nothing comes through, nobody knows yet */
};

/* Of two controllers. At both ends its handle is its place in the room, from 1 on. */
struct connection {
    enum stage stage;
    int caller;
    int called; /* NOBODY: no controller has this address */
    bdaddr_t address;
    int64_t until_ms; /* PAGING, ASKING, DYING */
    int64_t supervision_ms;
};

struct room {
    int count;
    struct controller controller[CONTROLLERS_MAX];
    struct connection connection[CONNECTIONS_MAX];
};

static int64_t now_ms(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static bdaddr_t address_of(int who)
{
    return (bdaddr_t){{(uint8_t)who, 0, 0, 0, 0, 0x02}}; /* last byte first */
}

static uint16_t handle_of(const struct room *room, const struct connection *connection)
{
    return (uint16_t)(connection - room->connection + 1);
}

/* Events to a host */

static void give(const struct room *room, int who, const uint8_t *packet, size_t count)
{
    if (who == NOBODY || room->controller[who].vhci < 0)
        return;
    if (write(room->controller[who].vhci, packet, count) != (ssize_t)count) {
        fprintf(stderr, "controller: hci%d: %s\n", who, strerror(errno));
        exit(1);
    }
}

static void tell(const struct room *room, int who, uint8_t event, const void *parameters,
                 size_t count)
{
    uint8_t packet[3 + UINT8_MAX] = {HCI_EVENT_PKT, event, (uint8_t)count};

    memcpy(packet + 3, parameters, count);
    give(room, who, packet, 3 + count);
}

/* That a command is done, and what it gives back. */
static void tell_complete(const struct room *room, int who, uint16_t opcode, const void *result,
                          size_t count)
{
    uint8_t parameters[UINT8_MAX] = {1, (uint8_t)opcode, (uint8_t)(opcode >> 8)};

    memcpy(parameters + 3, result, count);
    tell(room, who, EVT_CMD_COMPLETE, parameters, 3 + count);
}

/* That a command was understood, or not. */
static void tell_status(const struct room *room, int who, uint16_t opcode, uint8_t status)
{
    evt_cmd_status told = {.status = status, .ncmd = 1, .opcode = htobs(opcode)};

    tell(room, who, EVT_CMD_STATUS, &told, sizeof told);
}

static void tell_connected(const struct room *room, const struct connection *connection, int who,
                           uint8_t status)
{
    evt_conn_complete told = {
        .status = status,
        .handle = htobs(handle_of(room, connection)),
        .bdaddr = who == connection->caller ? connection->address : address_of(connection->caller),
        .link_type = ACL_LINK,
    };

    tell(room, who, EVT_CONN_COMPLETE, &told, sizeof told);
}

static void tell_disconnected(const struct room *room, const struct connection *connection, int who,
                              uint8_t reason)
{
    evt_disconn_complete told = {.handle = htobs(handle_of(room, connection)), .reason = reason};

    tell(room, who, EVT_DISCONN_COMPLETE, &told, sizeof told);
}

/* Connections */

static bool reachable(const struct room *room, int who)
{
    return who != NOBODY && room->controller[who].vhci >= 0 && !room->controller[who].away;
}

static int other_end(const struct connection *connection, int who)
{
    return who == connection->caller ? connection->called : connection->caller;
}

static bool has_end(const struct connection *connection, int who)
{
    return connection->caller == who || connection->called == who;
}

/* Who has this address, NOBODY if none. */
static int find_controller(const struct room *room, const bdaddr_t *address)
{
    for (int who = 0; who < room->count; who++) {
        bdaddr_t own = address_of(who);
        if (bacmp(&own, address) == 0)
            return who;
    }
    return NOBODY;
}

/* The connection with this handle and end, in this stage; NULL if there is none. */
static struct connection *find_connection(struct room *room, int who, uint16_t handle,
                                          enum stage stage)
{
    if (handle < 1 || handle > CONNECTIONS_MAX)
        return NULL;
    struct connection *connection = &room->connection[handle - 1];
    return connection->stage == stage && has_end(connection, who) ? connection : NULL;
}

/* Where `caller` calls this address and there is no answer yet; NULL if it does not. */
static struct connection *find_call(struct room *room, int caller, const bdaddr_t *address)
{
    for (struct connection *each = room->connection; each < room->connection + CONNECTIONS_MAX;
         each++) {
        if ((each->stage == PAGING || each->stage == ASKING) && each->caller == caller &&
            bacmp(&each->address, address) == 0)
            return each;
    }
    return NULL;
}

static void refuse(struct room *room, struct connection *connection, uint8_t status)
{
    tell_connected(room, connection, connection->caller, status);
    if (connection->stage == ASKING)
        tell_connected(room, connection, connection->called, status);
    connection->stage = FREE;
}

/* Whoever is called asks its host, as soon as it hears of it. */
static void page(struct room *room, struct connection *connection)
{
    if (!reachable(room, connection->caller) || !reachable(room, connection->called) ||
        !room->controller[connection->called].scanning)
        return;
    connection->stage = ASKING;
    evt_conn_request told = {.bdaddr = address_of(connection->caller), .link_type = ACL_LINK};
    tell(room, connection->called, EVT_CONN_REQUEST, &told, sizeof told);
}

static void end(struct room *room, struct connection *connection, uint8_t reason)
{
    tell_disconnected(room, connection, connection->caller, reason);
    tell_disconnected(room, connection, connection->called, reason);
    connection->stage = FREE;
}

/* What happens by itself. */
static void pass_time(struct room *room)
{
    int64_t now = now_ms();

    for (struct connection *each = room->connection; each < room->connection + CONNECTIONS_MAX;
         each++) {
        if (each->stage == PAGING)
            page(room, each);
        if (each->stage == FREE || each->stage == UP || now < each->until_ms)
            continue;
        if (each->stage == DYING)
            end(room, each, HCI_CONNECTION_TIMEOUT);
        else
            refuse(room, each, HCI_PAGE_TIMEOUT);
    }
}

static void lose_links(struct room *room, int who)
{
    for (struct connection *each = room->connection; each < room->connection + CONNECTIONS_MAX;
         each++) {
        if (each->stage != UP || !has_end(each, who))
            continue;
        each->stage = DYING;
        each->until_ms = now_ms() + each->supervision_ms;
    }
}

/* Commands of a host */

static void create_connection(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    const create_conn_cp *asked = (const create_conn_cp *)bytes;
    struct connection *free = room->connection;

    while (free < room->connection + CONNECTIONS_MAX && free->stage != FREE)
        free++;
    if (free == room->connection + CONNECTIONS_MAX) {
        tell_status(room, who, opcode, HCI_MAX_NUMBER_OF_CONNECTIONS);
        return;
    }
    *free = (struct connection){
        .stage = PAGING,
        .caller = who,
        .called = find_controller(room, &asked->bdaddr),
        .address = asked->bdaddr,
        .until_ms = now_ms() + PAGE_TIMEOUT_MS,
        .supervision_ms = SUPERVISION_TIMEOUT_MS,
    };
    tell_status(room, who, opcode, 0);
    page(room, free);
}

static void cancel_connection(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    const create_conn_cancel_cp *asked = (const create_conn_cancel_cp *)bytes;
    struct connection *call = find_call(room, who, &asked->bdaddr);
    struct {
        uint8_t status;
        bdaddr_t address;
    } __attribute__((packed)) result = {call ? 0 : HCI_NO_CONNECTION, asked->bdaddr};

    tell_complete(room, who, opcode, &result, sizeof result);
    if (call)
        refuse(room, call, HCI_NO_CONNECTION);
}

static void accept_connection(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    const accept_conn_req_cp *asked = (const accept_conn_req_cp *)bytes;
    bdaddr_t own = address_of(who);
    struct connection *call = find_call(room, find_controller(room, &asked->bdaddr), &own);

    tell_status(room, who, opcode, call ? 0 : HCI_NO_CONNECTION);
    if (!call)
        return;
    call->stage = UP;
    tell_connected(room, call, call->called, 0);
    tell_connected(room, call, call->caller, 0);
}

static void disconnect(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    const disconnect_cp *asked = (const disconnect_cp *)bytes;
    struct connection *connection = find_connection(room, who, btohs(asked->handle), UP);

    tell_status(room, who, opcode, connection ? 0 : HCI_NO_CONNECTION);
    if (!connection)
        return;
    tell_disconnected(room, connection, who, HCI_CONNECTION_TERMINATED);
    tell_disconnected(room, connection, other_end(connection, who), asked->reason);
    connection->stage = FREE;
}

static const uint8_t features[8] = {LMP_3SLOT | LMP_5SLOT | LMP_ENCRYPT};

static void read_remote_features(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    const read_remote_features_cp *asked = (const read_remote_features_cp *)bytes;
    evt_read_remote_features_complete told = {.handle = asked->handle};

    memcpy(told.features, features, sizeof features);
    tell_status(room, who, opcode, 0);
    tell(room, who, EVT_READ_REMOTE_FEATURES_COMPLETE, &told, sizeof told);
}

static void write_scan_enable(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    room->controller[who].scanning = (bytes[0] & SCAN_PAGE) != 0;
    tell_complete(room, who, opcode, &(uint8_t){0}, 1);
}

static void write_supervision_timeout(struct room *room, int who, uint16_t opcode,
                                      const uint8_t *bytes)
{
    const write_link_supervision_timeout_cp *asked =
        (const write_link_supervision_timeout_cp *)bytes;
    struct connection *connection = find_connection(room, who, btohs(asked->handle), UP);
    write_link_supervision_timeout_rp result = {connection ? 0 : HCI_NO_CONNECTION, asked->handle};

    if (connection)
        connection->supervision_ms = btohs(asked->timeout) * 5 / 8;
    tell_complete(room, who, opcode, &result, sizeof result);
}

static void read_local_version(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    read_local_version_rp result = {.hci_ver = 3, .lmp_ver = 3}; /* 2.0 */

    (void)bytes;
    tell_complete(room, who, opcode, &result, sizeof result);
}

static void read_local_features(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    read_local_features_rp result = {0};

    (void)bytes;
    memcpy(result.features, features, sizeof features);
    tell_complete(room, who, opcode, &result, sizeof result);
}

static void read_buffer_size(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    read_buffer_size_rp result = {.acl_mtu = htobs(339), .acl_max_pkt = htobs(8)};

    (void)bytes;
    tell_complete(room, who, opcode, &result, sizeof result);
}

static void read_address(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    read_bd_addr_rp result = {.bdaddr = address_of(who)};

    (void)bytes;
    tell_complete(room, who, opcode, &result, sizeof result);
}

/* Everything else that the kernel asks or sets while it starts a controller: done, and all zeros.
 */
static void do_nothing(struct room *room, int who, uint16_t opcode, const uint8_t *bytes)
{
    static const uint8_t zeros[UINT8_MAX - 3];

    (void)bytes;
    if (cmd_opcode_ogf(opcode) == OGF_LINK_CTL)
        tell_status(room, who, opcode, HCI_UNKNOWN_COMMAND);
    else
        tell_complete(room, who, opcode, zeros, sizeof zeros);
}

static const struct command {
    uint16_t opcode;
    uint8_t size; /* of what comes with it, at least */
    void (*obey)(struct room *room, int who, uint16_t opcode, const uint8_t *bytes);
} commands[] = {
    {OPCODE(OGF_LINK_CTL, OCF_CREATE_CONN), CREATE_CONN_CP_SIZE, create_connection},
    {OPCODE(OGF_LINK_CTL, OCF_CREATE_CONN_CANCEL), CREATE_CONN_CANCEL_CP_SIZE, cancel_connection},
    {OPCODE(OGF_LINK_CTL, OCF_ACCEPT_CONN_REQ), ACCEPT_CONN_REQ_CP_SIZE, accept_connection},
    {OPCODE(OGF_LINK_CTL, OCF_DISCONNECT), DISCONNECT_CP_SIZE, disconnect},
    {OPCODE(OGF_LINK_CTL, OCF_READ_REMOTE_FEATURES), READ_REMOTE_FEATURES_CP_SIZE,
     read_remote_features},
    {OPCODE(OGF_HOST_CTL, OCF_WRITE_SCAN_ENABLE), 1, write_scan_enable},
    {OPCODE(OGF_HOST_CTL, OCF_WRITE_LINK_SUPERVISION_TIMEOUT),
     WRITE_LINK_SUPERVISION_TIMEOUT_CP_SIZE, write_supervision_timeout},
    {OPCODE(OGF_INFO_PARAM, OCF_READ_LOCAL_VERSION), 0, read_local_version},
    {OPCODE(OGF_INFO_PARAM, OCF_READ_LOCAL_FEATURES), 0, read_local_features},
    {OPCODE(OGF_INFO_PARAM, OCF_READ_BUFFER_SIZE), 0, read_buffer_size},
    {OPCODE(OGF_INFO_PARAM, OCF_READ_BD_ADDR), 0, read_address},
};

static void take_command(struct room *room, int who, const uint8_t *bytes, size_t count)
{
    if (count < HCI_COMMAND_HDR_SIZE)
        return;
    uint16_t opcode = (uint16_t)(bytes[0] | bytes[1] << 8);
    const struct command *command = commands, *last = commands + sizeof commands / sizeof *commands;

    while (command < last && command->opcode != opcode)
        command++;
    if (command == last)
        do_nothing(room, who, opcode, bytes);
    else if (count - HCI_COMMAND_HDR_SIZE >= command->size)
        command->obey(room, who, opcode, bytes + HCI_COMMAND_HDR_SIZE);
}

/* Data goes to the other end. Of what is lost the host is never told that it has been sent: a real
 * controller keeps trying. */
static void take_data(struct room *room, int who, uint8_t *packet, size_t count)
{
    if (count < 1 + HCI_ACL_HDR_SIZE)
        return;
    uint16_t field = (uint16_t)(packet[1] | packet[2] << 8), handle = acl_handle(field);
    struct connection *connection = find_connection(room, who, handle, UP);
    struct {
        uint8_t handles;
        uint16_t handle, packets;
    } __attribute__((packed)) done = {1, htobs(handle), htobs(1)};

    if (!connection)
        return;
    /* To its host a controller never says of a first part that it must not be flushed. */
    uint16_t part = acl_flags(field) == ACL_START_NO_FLUSH ? ACL_START : acl_flags(field);
    field = acl_handle_pack(handle, part);
    packet[1] = (uint8_t)field;
    packet[2] = (uint8_t)(field >> 8);
    give(room, other_end(connection, who), packet, count);
    tell(room, who, EVT_NUM_COMP_PKTS, &done, sizeof done);
}

static void take_packet(struct room *room, int who)
{
    uint8_t packet[HCI_MAX_FRAME_SIZE];
    ssize_t count = read(room->controller[who].vhci, packet, sizeof packet);

    if (count > 0 && packet[0] == HCI_COMMAND_PKT)
        take_command(room, who, packet + 1, (size_t)count - 1);
    else if (count > 0 && packet[0] == HCI_ACLDATA_PKT)
        take_data(room, who, packet, (size_t)count);
}

/* The room */

/* A descriptor of the controller that the kernel calls hci<who>, or -1 with errno. */
static int plug_in(int who)
{
    const uint8_t primary[] = {HCI_VENDOR_PKT, 0};
    uint8_t answer[4];
    int vhci = open("/dev/vhci", O_RDWR | O_CLOEXEC);

    if (vhci < 0)
        return -1;
    if (write(vhci, primary, sizeof primary) != sizeof primary ||
        read(vhci, answer, sizeof answer) != sizeof answer)
        return -1;
    if (answer[2] != who) {
        errno = EEXIST;
        return -1;
    }
    return vhci;
}

static bool obey_line(struct room *room, const char *line)
{
    char verb[8];
    int who;

    if (sscanf(line, "%7s %d", verb, &who) != 2 || who < 0 || who >= room->count)
        return false;
    struct controller *controller = &room->controller[who];
    if (strcmp(verb, "mend") == 0) {
        controller->away = false;
        return true;
    }
    lose_links(room, who);
    if (strcmp(verb, "cut") == 0) {
        controller->away = true;
        return true;
    }
    if (strcmp(verb, "unplug") != 0 || controller->vhci < 0)
        return false;
    close(controller->vhci);
    controller->vhci = -1;
    return true;
}

/* False at the end of stdin. A line is expected in one write. */
static bool take_line(struct room *room)
{
    char line[32];
    ssize_t count = read(STDIN_FILENO, line, sizeof line - 1);

    if (count <= 0)
        return false;
    line[count] = '\0';
    if (!obey_line(room, line))
        fprintf(stderr, "controller: not understood: %s", line);
    return true;
}

static void run(struct room *room)
{
    struct pollfd watched[1 + CONTROLLERS_MAX];

    for (;;) {
        watched[0] = (struct pollfd){.fd = STDIN_FILENO, .events = POLLIN};
        for (int who = 0; who < room->count; who++)
            watched[1 + who] = (struct pollfd){.fd = room->controller[who].vhci, .events = POLLIN};
        poll(watched, 1 + (nfds_t)room->count, TICK_MS);
        for (int who = 0; who < room->count; who++) {
            if (watched[1 + who].revents != 0)
                take_packet(room, who);
        }
        if (watched[0].revents != 0 && !take_line(room))
            return;
        pass_time(room);
    }
}

int main(int argc, char **argv)
{
    struct room room = {.count = argc == 2 ? atoi(argv[1]) : 0};

    if (room.count < 1 || room.count > CONTROLLERS_MAX) {
        fprintf(stderr, "usage: controller N, 1 to %d\n", CONTROLLERS_MAX);
        return 2;
    }
    for (int who = 0; who < room.count; who++) {
        room.controller[who].vhci = plug_in(who);
        if (room.controller[who].vhci < 0) {
            fprintf(stderr, "controller: /dev/vhci: hci%d: %s\n", who, strerror(errno));
            return 1;
        }
    }
    run(&room);
    return 0;
}
