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
    const struct server *server;
    const struct server_formation *formation;
    bool vertices_are_rows;
};

static double matching_cost(const void *context, size_t row, size_t column)
{
    const struct matching *m = context;
    const struct server *s = m->server;
    size_t robot = s->followers[m->vertices_are_rows ? column : row];
    uint16_t vertex = s->vertices[m->vertices_are_rows ? row : column];
    const struct polar_vertex *v = &m->formation->vertex[vertex - 1];
    const struct server_pose *leader = &s->member[s->leader].pose;
    const struct server_pose *pose = &s->member[robot].pose;
    double distance = (double)v->distance / NARROW_PER_M;
    double direction = leader->theta + v->psi * 2 * M_PI / ANGLE_TURN;

    return hypot(leader->x + distance * cos(direction) - pose->x,
                 leader->y + distance * sin(direction) - pose->y);
}

static void assign_optimal(struct server *s, const struct server_formation *formation)
{
    uint16_t leader = leader_vertex(formation);
    size_t followers = 0;
    size_t vertices = 0;

    for (size_t i = 0; i < s->config->robot_count; i++) {
        s->member[i].assigned = 0;
        if (s->member[i].view.linked && i != s->leader)
            s->followers[followers++] = i;
    }
    for (uint16_t v = 1; v <= formation->count; v++)
        if (v != leader)
            s->vertices[vertices++] = v;

    struct matching matching = {s, formation, vertices < followers};
    size_t rows = vertices < followers ? vertices : followers;
    size_t columns = vertices < followers ? followers : vertices;
    assignment_solve(rows, columns, matching_cost, &matching, s->nodes, s->chosen);
    for (size_t row = 0; row < rows; row++) {
        size_t follower = matching.vertices_are_rows ? s->chosen[row] : row;
        size_t vertex = matching.vertices_are_rows ? row : s->chosen[row];

        s->member[s->followers[follower]].assigned = s->vertices[vertex];
    }
    s->member[s->leader].assigned = leader;
}

void host_allocate(struct server *s)
{
    const struct server_formation *formation = &s->config->formations[s->formation];

    if (!s->assign_due || !host_allocates(s) || s->leader == SERVER_NOBODY)
        return;
    s->assign_due = false;
    if (s->config->allocation == SERVER_RIGID)
        assign_rigid(s, formation);
    else
        assign_optimal(s, formation);
}
