#include "figures.h"

/* What is known of a figure before anything has run. */
struct entry {
    int number;
    const char *title, *shows;
    void (*of_all)(struct figure *figure, const struct runs *runs);
    void (*of_one)(struct figure *figure, const struct run *run);
    size_t run; /* of_one's, as an index into runs->all */
};

#define INDEX_OF(member) (offsetof(struct runs, member) / sizeof(struct run))

static const struct entry entries[FIGURE_COUNT] = {
    {1, "Three motion laws",
     "One robot alone follows a straight reference and a circle of 2 m radius at 0.5 m/s, from a "
     "start 1 m beside it, once with its heading and once turned away. fl is the "
     "feedback-linearising law with the gains of all other runs, k = 1 and k_theta = 3. The gains "
     "of kanayama and pid are matched to it: scaled, both alike, until the robot settles to "
     "within 5 cm as soon as with fl on the straight task. The other tasks are run with these "
     "gains as they are. No law may ask for more than 10 rad/s.",
     figure_of_laws, NULL, 0},
    {5, "Leader fault, four robots: routes",
     "Simulation 1: four robots, two of them candidates; the leader is switched off at 10 s.", NULL,
     figure_of_fault_routes, INDEX_OF(fault[CPA])},
    {6, "Leader fault, four robots: the moments of change",
     "Simulation 1: who is where, who leads (L), follows (F) or is a candidate (C), and who holds "
     "which vertex. Hollow circles are the vertices about the leader.",
     NULL, figure_of_fault_roles, INDEX_OF(fault[CPA])},
    {7, "Leader fault, four robots: distance errors", "Simulation 1.", NULL, figure_of_fault_errors,
     INDEX_OF(fault[CPA])},
    {8, "Formation change, four robots: routes and the moments of change",
     "Simulation 2: the same four robots; the formation changes from G1 to G2 at 15 s.", NULL,
     figure_of_change, INDEX_OF(change[CPA])},
    {9, "Formation change, four robots: distance errors", "Simulation 2.", NULL,
     figure_of_change_errors, INDEX_OF(change[CPA])},
    {10, "Three allocations compared, four robots",
     "Both simulations again with the vertices given out by the host: rigid, robot k takes vertex "
     "k; optimal, the least sum of distances, anew whenever a leader or a formation takes effect.",
     figure_of_schemes, NULL, 0},
    {11, "A hundred robots",
     "Robot i starts at (i - 50, 0), candidates are 45 to 55, the reference starts 5.45 m ahead. "
     "The formation as it is printed is no V; two V that it may stand for are run beside it. Each "
     "is run with a range of 1 m, as in the simulations of four robots, and of 3 m.",
     figure_of_hundred, NULL, 0},
    {14, "Experiment 1, leader fault: routes",
     "The experiment as a simulation of the small robot: its size, wheel limits and motor lag, "
     "poses as motion capture has them, a radio as late as a real one. The leader is lost when it "
     "has passed y = 1; it stays there, and those behind it drive over it, for the paper has no "
     "avoidance. Printed are reference, candidates, event and L; chosen are poses and range. psi "
     "as printed puts two vertices into one place, so vertex 2 is at pi/2 here.",
     NULL, figure_of_fault_routes, INDEX_OF(fault_experiment)},
    {15, "Experiment 1, leader fault: the moments of change",
     "As figure 14: roles, positions and vertices.", NULL, figure_of_fault_roles,
     INDEX_OF(fault_experiment)},
    {16, "Experiment 1, leader fault: distance errors", "As figure 14.", NULL,
     figure_of_fault_errors, INDEX_OF(fault_experiment)},
    {17, "Experiment 2, formation change: routes",
     "The experiment as a simulation of the small robot, as in figure 14. The formation changes "
     "from Y to Delta when the leader has passed y = 1. Poses and range are chosen, the rest is "
     "printed.",
     NULL, figure_of_change_routes, INDEX_OF(change_experiment)},
    {18, "Experiment 2, formation change: the moments of change",
     "As figure 17: roles, positions and vertices.", NULL, figure_of_change_vertices,
     INDEX_OF(change_experiment)},
    {19, "Experiment 2, formation change: distance errors", "As figure 17.", NULL,
     figure_of_change_errors, INDEX_OF(change_experiment)},
};

int figure_number(size_t i)
{
    return entries[i].number;
}

void figure_fill(struct figure *figure, size_t i, const struct runs *runs)
{
    const struct entry *entry = &entries[i];

    *figure =
        (struct figure){.number = entry->number, .title = entry->title, .shows = entry->shows};
    if (entry->of_all != NULL)
        entry->of_all(figure, runs);
    else
        entry->of_one(figure, &runs->all[entry->run]);
}
