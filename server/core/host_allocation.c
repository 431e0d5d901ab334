#include "server_state.h"

#include <math.h>

static uint16_t leader_vertex(const struct server_formation *formation)
{
    for (uint16_t i = 0; i < formation->count; i++)
        if (formation->vertex[i].distance == 0)
            return i + 1;
    return 0;
}

/* The k-th robot has vertex k; the leader swaps with the robot whose vertex is the leader's. */
static void assign_rigid(struct server *s, const struct server_formation *formation)
{
    uint16_t leader = leader_vertex(formation);

    for (size_t i = 0; i < s->config->robot_count; i++) {
        uint16_t vertex = i < formation->count ? (uint16_t)(i + 1) : 0;

        if (vertex == leader)
            vertex = s->leader < formation->count ? (uint16_t)(s->leader + 1) : 0;
        s->member[i].assigned = vertex;
    }
    s->member[s->leader].assigned = leader;
}

/* Followers and vertices, whichever are fewer being the rows. */
struct matching {
    const struct site *row, *column;
};

static double matching_cost(const void *context, size_t row, size_t column)
{
    const struct matching *m = context;

    return hypot(m->row[row].x - m->column[column].x, m->row[row].y - m->column[column].y);
}

static size_t list_followers(struct server *s)
{
    size_t count = 0;

    for (size_t i = 0; i < s->config->robot_count; i++) {
        const struct server_pose *pose = &s->member[i].pose;
        const struct server_view *view = &s->member[i].view;

        if (view->linked && !(view->faults & FAULT_BATTERY) && i != s->leader)
            s->followers[count++] = (struct site){pose->x, pose->y, i};
    }
    return count;
}

static size_t list_vertices(struct server *s, const struct server_formation *formation)
{
    const struct server_pose *leader = &s->member[s->leader].pose;
    size_t count = 0;

    for (size_t i = 0; i < formation->count; i++) {
        const struct polar_vertex *v = &formation->vertex[i];
        double distance = (double)v->distance / NARROW_PER_M;
        double direction = leader->theta + v->psi * 2 * M_PI / ANGLE_TURN;

        if (v->distance != 0)
            s->vertices[count++] = (struct site){leader->x + distance * cos(direction),
                                                 leader->y + distance * sin(direction), i + 1};
    }
    return count;
}

static void assign(struct server *s, const struct site *follower, const struct site *vertex)
{
    s->member[follower->name].assigned = (uint16_t)vertex->name;
}

static void assign_optimal(struct server *s, const struct server_formation *formation)
{
    size_t followers = list_followers(s);
    size_t vertices = list_vertices(s, formation);
    struct matching by_follower = {s->followers, s->vertices};
    struct matching by_vertex = {s->vertices, s->followers};

    for (size_t i = 0; i < s->config->robot_count; i++)
        s->member[i].assigned = 0;
    s->member[s->leader].assigned = leader_vertex(formation);
    if (followers <= vertices) {
        assignment_solve(followers, vertices, matching_cost, &by_follower, s->nodes, s->chosen);
        for (size_t i = 0; i < followers; i++)
            assign(s, &s->followers[i], &s->vertices[s->chosen[i]]);
    } else {
        assignment_solve(vertices, followers, matching_cost, &by_vertex, s->nodes, s->chosen);
        for (size_t i = 0; i < vertices; i++)
            assign(s, &s->followers[s->chosen[i]], &s->vertices[i]);
    }
}

void host_allocate(struct server *s)
{
    const struct server_formation *formation = server_formation_at(s, s->formation);

    if (!s->assign_due || !host_allocates(s) || s->leader == SERVER_NOBODY)
        return;
    s->assign_due = false;
    if (s->config->allocation == SERVER_RIGID)
        assign_rigid(s, formation);
    else
        assign_optimal(s, formation);
}
