/* kernel_time.h: when bytes arrived at a socket, by the kernel. */
#ifndef KERNEL_TIME_H
#define KERNEL_TIME_H

#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

/* CLOCK_REALTIME, in which the kernel tells arrivals, ns. */
int64_t real_ns(void);

/* From now on the kernel notes it at this socket. */
void want_time(int fd);

/* As recv() without flags; `at` is when the newest of what is received arrived. */
ssize_t receive_at(int fd, void *bytes, size_t room, int64_t *at);

#endif
