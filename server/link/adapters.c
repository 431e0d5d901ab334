#include "adapters.h"

#include <bluetooth/bluetooth.h>
#include <bluetooth/hci.h>
#include <bluetooth/hci_lib.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

/* A robot that is there has answered by then, SDP included. */
#define PATIENCE_US 1500000

static bool read_one(int fd, uint16_t number, struct link_adapter *adapter)
{
    struct hci_dev_info info = {.dev_id = number};
    bdaddr_t written;

    if (ioctl(fd, HCIGETDEVINFO, &info) != 0)
        return false;
    baswap(&written, &info.bdaddr);
    *adapter = (struct link_adapter){.number = number, .up = hci_test_bit(HCI_UP, &info.flags)};
    memcpy(adapter->address, &written, sizeof adapter->address);
    return true;
}

size_t adapters_read(struct link_adapter list[LINK_ADAPTERS_MAX])
{
    int fd = socket(AF_BLUETOOTH, SOCK_RAW | SOCK_CLOEXEC, BTPROTO_HCI);
    size_t count = 0;

    if (fd < 0)
        return 0;
    for (uint16_t number = 0; number < LINK_ADAPTERS_MAX; number++)
        count += read_one(fd, number, &list[count]);
    close(fd);
    return count;
}

static struct adapter *find(struct adapters *adapters, int number)
{
    for (size_t i = 0; i < adapters->count; i++)
        if (adapters->adapter[i].seen.number == number)
            return &adapters->adapter[i];
    return NULL;
}

enum need { NEED_ANY, NEED_UP, NEED_IDLE };

static bool meets(const struct adapter *adapter, enum need need)
{
    return need == NEED_ANY || (adapter->seen.up && (need == NEED_UP || !adapter->dialling));
}

/* The place of the adapter that has room and the fewest robots, but not that of `but`; `count` for
 * none. */
static size_t emptiest(const struct adapters *adapters, size_t but, enum need need)
{
    size_t best = adapters->count;
    size_t least = LINK_ADAPTER_ROBOTS;

    for (size_t i = 0; i < adapters->count; i++) {
        const struct adapter *adapter = &adapters->adapter[i];

        if (i == but || !meets(adapter, need) || adapter->seen.robots >= least)
            continue;
        best = i;
        least = adapter->seen.robots;
    }
    return best;
}

static void settle(struct adapters *adapters, struct adapter_caller *caller, size_t place)
{
    caller->own = place;
    adapters->adapter[place].seen.robots++;
}

static bool move(struct adapters *adapters, struct adapter_caller *caller, enum need need)
{
    size_t place = emptiest(adapters, caller->own, need);

    if (caller->wanted >= 0 || place == adapters->count)
        return false;
    adapters->adapter[caller->own].seen.robots--;
    settle(adapters, caller, place);
    return true;
}

void adapters_refresh(struct adapters *adapters, const struct link_adapter *list, size_t count,
                      struct adapter_caller *callers, size_t caller_count)
{
    for (size_t i = 0; i < adapters->count; i++)
        adapters->adapter[i].seen.up = false;
    for (size_t i = 0; i < count; i++) {
        struct adapter *known = find(adapters, list[i].number);

        if (known == NULL && adapters->count < LINK_ADAPTERS_MAX) {
            known = &adapters->adapter[adapters->count++];
            *known = (struct adapter){.seen.number = list[i].number};
        }
        if (known == NULL)
            continue;
        known->seen.up = list[i].up;
        memcpy(known->seen.address, list[i].address, sizeof known->seen.address);
    }
    for (size_t i = 0; i < caller_count; i++) {
        struct adapter_caller *caller = &callers[i];

        if (caller->bluetooth && caller->waits && !adapters->adapter[caller->own].seen.up)
            move(adapters, caller, NEED_UP);
    }
}

static bool give_wanted(struct adapters *adapters, struct adapter_caller *caller, char *error,
                        size_t room)
{
    struct adapter *wanted = find(adapters, caller->wanted);

    if (wanted == NULL) {
        snprintf(error, room,
                 "hci%d: this host has no such Bluetooth adapter (`hciconfig` lists them)",
                 caller->wanted);
        return false;
    }
    if (wanted->seen.robots == LINK_ADAPTER_ROBOTS) {
        snprintf(error, room, "hci%d: an adapter has at most %d robots", caller->wanted,
                 LINK_ADAPTER_ROBOTS);
        return false;
    }
    settle(adapters, caller, (size_t)(wanted - adapters->adapter));
    return true;
}

static bool give_any(struct adapters *adapters, struct adapter_caller *caller, char *error,
                     size_t room)
{
    size_t place = emptiest(adapters, adapters->count, NEED_UP);

    if (place == adapters->count)
        place = emptiest(adapters, adapters->count, NEED_ANY);
    if (place == adapters->count) {
        snprintf(error, room,
                 "too few Bluetooth adapters: this host has %zu, and each has at most %d robots",
                 adapters->count, LINK_ADAPTER_ROBOTS);
        return false;
    }
    settle(adapters, caller, place);
    return true;
}

bool adapters_spread(struct adapters *adapters, struct adapter_caller *callers, size_t count,
                     char *error, size_t room)
{
    for (size_t i = 0; i < count; i++)
        if (callers[i].bluetooth && callers[i].wanted >= 0 &&
            !give_wanted(adapters, &callers[i], error, room))
            return false;
    for (size_t i = 0; i < count; i++)
        if (callers[i].bluetooth && callers[i].wanted < 0 &&
            !give_any(adapters, &callers[i], error, room))
            return false;
    return true;
}

static bool is_due(const struct adapter_caller *caller, int64_t now_us)
{
    return caller->bluetooth && caller->waits && now_us >= caller->due_us;
}

static bool may_dial(const struct adapters *adapters, const struct adapter_caller *caller,
                     int64_t now_us)
{
    if (!is_due(caller, now_us))
        return false;
    const struct adapter *own = &adapters->adapter[caller->own];
    return own->seen.up && !own->dialling && (caller->absent == 0 || now_us >= own->rest_us);
}

/* A robot that waits behind one that seems to be absent, now with an adapter that has nothing to
 * do; `count` for none. */
static size_t relieve(struct adapters *adapters, struct adapter_caller *callers, size_t count,
                      int64_t now_us)
{
    for (size_t i = 0; i < count; i++) {
        if (!is_due(&callers[i], now_us) || callers[i].absent > 0)
            continue;
        const struct adapter *own = &adapters->adapter[callers[i].own];
        if (own->dialling && now_us - own->dialled_us >= PATIENCE_US &&
            move(adapters, &callers[i], NEED_IDLE))
            return i;
    }
    return count;
}

size_t adapters_next(struct adapters *adapters, struct adapter_caller *callers, size_t count,
                     int64_t now_us)
{
    size_t next = count;

    for (size_t i = 0; i < count; i++) {
        const struct adapter_caller *caller = &callers[i];

        if (!may_dial(adapters, caller, now_us))
            continue;
        if (next == count || caller->absent < callers[next].absent ||
            (caller->absent == callers[next].absent && caller->due_us < callers[next].due_us))
            next = i;
    }
    if (next < count && callers[next].absent == 0)
        return next;
    size_t relieved = relieve(adapters, callers, count, now_us);
    return relieved < count ? relieved : next;
}

void adapters_begin(struct adapters *adapters, struct adapter_caller *caller, int64_t now_us)
{
    struct adapter *own = &adapters->adapter[caller->own];

    caller->waits = false;
    own->dialling = true;
    own->dialled_us = now_us;
}

/* Paging takes air from the robots that are connected: they have it half of the time at least. */
void adapters_end(struct adapters *adapters, struct adapter_caller *caller,
                  enum adapter_outcome outcome, int64_t now_us)
{
    struct adapter *own = &adapters->adapter[caller->own];

    own->dialling = false;
    if (outcome != ADAPTER_ABSENT) {
        caller->absent = 0;
        own->connected += outcome == ADAPTER_CONNECTED;
        return;
    }
    caller->absent++;
    if (own->connected > 0)
        own->rest_us = now_us + (now_us - own->dialled_us);
    move(adapters, caller, NEED_UP);
}

void adapters_lose(struct adapters *adapters, const struct adapter_caller *caller)
{
    adapters->adapter[caller->own].connected--;
}

const char *adapters_warn(const char *release)
{
    static const char *const bad[] = {"6.1.0-55-", "6.1.0-56-"};

    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        if (strncmp(release, bad[i], strlen(bad[i])) == 0)
            return "Debian's kernels 6.1.0-55 and 6.1.0-56 crash when a Bluetooth robot that is "
                   "absent is "
                   "dialled; use 6.1.0-54 or 6.12";
    return NULL;
}
