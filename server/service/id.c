#include "id.h"

/* Another link that says it has this id; the link's own place where there is none. */
static size_t find(const struct id_link *links, size_t count, size_t own, uint16_t id)
{
    for (size_t i = 0; i < count; i++)
        if (i != own && links[i].answered && links[i].has == id)
            return i;
    return own;
}

/* Somebody keeps it, or has been given it. */
static bool is_used(const struct id_link *links, size_t count, uint16_t id)
{
    for (size_t i = 0; i < count; i++)
        if ((links[i].verdict == ID_GETS && links[i].gets == id) ||
            (links[i].verdict != ID_GETS && links[i].answered && links[i].has == id))
            return true;
    return false;
}

static enum id_verdict judge_by_site(const struct id_link *link, bool taken, bool force)
{
    if (link->has == link->wanted)
        return ID_KEEPS;
    if (link->has != 0 && !force)
        return ID_OTHER;
    return taken && !force ? ID_TAKEN : ID_GETS;
}

static enum id_verdict judge_by_row(const struct id_link *link, bool twice, bool force)
{
    if (link->has == 0 || force)
        return ID_GETS;
    return twice ? ID_TWICE : ID_KEEPS;
}

static void judge(struct id_link *links, size_t count, size_t i, bool force)
{
    struct id_link *link = &links[i];
    bool by_site = link->wanted != 0;
    /* Of one that has none, who has the one that it is to get. */
    uint16_t sought = link->has == 0 ? link->wanted : link->has;

    link->twin = i;
    link->verdict = ID_SILENT;
    if (!link->answered)
        return;
    if (sought != 0)
        link->twin = find(links, count, i, sought);
    link->verdict = by_site ? judge_by_site(link, link->twin != i, force)
                            : judge_by_row(link, link->twin != i, force);
    link->gets = link->wanted;
}

void id_judge(struct id_link *links, size_t count, uint16_t first, bool force)
{
    for (size_t i = 0; i < count; i++)
        judge(links, count, i, force);
    for (size_t i = 0; i < count; i++) {
        if (links[i].verdict != ID_GETS || links[i].wanted != 0)
            continue;
        while (is_used(links, count, first))
            first++;
        links[i].gets = first++;
    }
}
