/* What measured jobs and the board know of each other. */
#ifndef BOARD_H
#define BOARD_H

#include <stddef.h>

typedef struct {
    const void *memory;
    size_t size;
} Shown;

/* shown: what is printed after a run, byte by byte; none if it is not asked for. */
typedef struct {
    void (*run)(void);
    const Shown *shown;
    int shown_count;
} Job;

extern const Job jobs[];
extern const int job_count;

void fault(const char *message);
#define FAULT(message) fault(message)

#endif
