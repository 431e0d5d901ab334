#include "election.h"

void election_begin(struct election *election, bool candidate)
{
    *election = (struct election){.role = candidate ? ROLE_CANDIDATE : ROLE_FOLLOWER};
}

static void follow(struct election *election, const struct message_beacon *leader, int32_t now)
{
    election->leader = leader->id;
    election->term = leader->term;
    election->word = now;
    election->role = ROLE_FOLLOWER; /* t2 */
}

/* A leader's beacon. The one followed now gives way to a later term, then to a smaller id. */
static void hear_leader(struct election *election, const struct message_beacon *beacon, int32_t now)
{
    bool known = beacon->id == election->leader;
    bool better = beacon->term > election->term ||
                  (beacon->term == election->term && beacon->id < election->leader);

    if (known || election->leader == 0 || better)
        follow(election, beacon, now);
}

void election_hear(struct election *election, const struct message_beacon *beacon, uint16_t own,
                   int32_t now)
{
    if (beacon->term > election->latest_term)
        election->latest_term = beacon->term;

    if (beacon->role == ROLE_LEADER && !beacon->fault) {
        hear_leader(election, beacon, now);
        return;
    }
    if (election->leader == 0 || election->leader == own)
        return;
    if (beacon->id == election->leader) {
        election->leader = 0; /* its own report */
        return;
    }
    if (beacon->term == election->term && beacon->leader_age != UINT8_MAX) {
        int16_t since = (int16_t)(uint16_t)((uint16_t)now - beacon->time);
        int32_t word = now - since - beacon->leader_age * (int32_t)TICK_MS;

        if (word > election->word && word <= now)
            election->word = word;
    }
}

bool election_ripe(const struct election *election)
{
    return election->role == ROLE_CANDIDATE && election->leader == 0 &&
           election->waited >= ELECTION_WINDOW_TICKS;
}

static void lead(struct election *election, const struct election_view *view)
{
    election->role = ROLE_LEADER;
    election->leader = view->own;
    election->term = ++election->latest_term;
}

void election_step(struct election *election, const struct election_view *view)
{
    bool leads = election->role == ROLE_LEADER;

    if (election->leader != 0 && !leads && view->now - election->word > ELECTION_SILENCE_MS)
        election->leader = 0;
    if (!view->candidate)
        return;

    if (leads && !view->able)
        election->leader = 0;
    if (election->leader != 0)
        return;

    if (election->role != ROLE_CANDIDATE) { /* t3 */
        election->role = ROLE_CANDIDATE;
        election->waited = 0;
    } else if (!election_ripe(election)) {
        election->waited++;
    } else if (view->able && view->closest) { /* t1 */
        lead(election, view);
    }
}

uint8_t election_leader_age(const struct election *election, uint16_t own, int32_t time)
{
    if (election->leader == 0)
        return UINT8_MAX;

    int32_t since = time - election->word;
    if (election->leader == own || since <= 0)
        return 0;
    if (since >= UINT8_MAX * TICK_MS)
        return UINT8_MAX;
    return (uint8_t)(((uint16_t)since + TICK_MS - 1) / TICK_MS);
}
