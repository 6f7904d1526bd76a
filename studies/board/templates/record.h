/* A simulated record of data, and record_x, the states that Python makes of it. */
#ifndef RECORD_H
#define RECORD_H

#include "filter.h"

enum { $enum };

$data

#endif
