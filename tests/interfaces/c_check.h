/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELOS_C_CHECK_H
#define DELOS_C_CHECK_H
/* What the hosts in C check with; they print what fails, and nothing else. */
#include <delos/delos.h>
#include <stdio.h>
#include <string.h>

static int n_failed = 0;

#define CHECK(condition)                                                  \
  do {                                                                    \
    if (!(condition)) {                                                   \
      fprintf(stderr, "%s:%d: not %s\n", __FILE__, __LINE__, #condition); \
      ++n_failed;                                                         \
    }                                                                     \
  } while (0)

/* The status, and what the text must contain. */
#define CHECK_FAILS(call, wanted, handle, part)                           \
  do {                                                                    \
    CHECK((call) == (wanted));                                            \
    if (strstr(delos_last_error(handle), part) == NULL) {                 \
      fprintf(stderr, "%s:%d: \"%s\" lacks \"%s\"\n", __FILE__, __LINE__, \
              delos_last_error(handle), part);                            \
      ++n_failed;                                                         \
    }                                                                     \
  } while (0)

#endif
