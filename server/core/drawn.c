#include "server_state.h"

#include <string.h>

/* Before a formation's number stands for another one: robots that are still being told of it are
 * told everything anew, for parts of two must not be taken for one. */
static void withdraw(struct server *s, uint8_t number)
{
    for (size_t i = 0; i < s->config->robot_count; i++)
        if (upload_mentions(&s->member[i].upload, number))
            downlink_begin(s, i);
}

void server_take_formation(struct server *s, uint16_t formation)
{
    s->formation = formation;
    s->formation_number = s->formation_number == UINT8_MAX ? 1 : s->formation_number + 1;
    withdraw(s, s->formation_number);
    s->formation_of[s->formation_number] = formation;
    s->assign_due = true;
}

const struct server_formation *server_formation_at(const struct server *s, uint16_t formation)
{
    size_t fixed = s->config->formation_count;

    return formation < fixed ? &s->config->formations[formation] : &s->drawn[formation - fixed];
}

static size_t next_place(struct server *s)
{
    size_t place = s->drawn_next;

    if (s->formation == s->config->formation_count + place)
        place = (place + 1) % SERVER_DRAWN_MAX;
    s->drawn_next = (place + 1) % SERVER_DRAWN_MAX;
    return place;
}

uint16_t server_draw(struct server *s, const struct server_formation *formation)
{
    size_t place = next_place(s);
    struct polar_vertex *vertex = &s->drawn_vertex[place * s->config->drawn_vertices];
    uint16_t index = (uint16_t)(s->config->formation_count + place);

    for (unsigned number = 1; number <= UINT8_MAX; number++)
        if (s->formation_of[number] == index)
            withdraw(s, (uint8_t)number);
    memcpy(vertex, formation->vertex, formation->count * sizeof *vertex);
    s->drawn[place] = *formation;
    s->drawn[place].vertex = vertex;
    server_take_formation(s, index);
    server_add_report(s, REPORT_EVENT, SERVER_NOBODY, EVENT_FORMATION, 0);
    return index;
}
