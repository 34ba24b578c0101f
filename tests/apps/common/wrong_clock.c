/* SPDX-License-Identifier: MIT */
/* Preloaded into a program: from the n-th call on (PH_CLOCK_FROM=n) the clocks are wrong.
   PH_CLOCK says how:
     back    each call tells a time one hour earlier than the previous call
     ahead   the first call is a hundred years ahead, the others two hundred
     frozen  each call tells the same time
     fails   each call fails and does not change its output
     leaps   each call does one of these at random */
#define _GNU_SOURCE
#include <errno.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#define HOUR 3600LL
#define CENTURY (100LL * 365 * 24 * HOUR)

static atomic_long calls;

/* Pseudo-random bits from the number of the call (splitmix64). */
static unsigned chance(uint64_t call) {
  call += 0x9e3779b97f4a7c15u;
  call = (call ^ (call >> 30)) * 0xbf58476d1ce4e5b9u;
  call = (call ^ (call >> 27)) * 0x94d049bb133111ebu;
  return (unsigned)(call >> 40);
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  const char* how = getenv("PH_CLOCK");
  const char* from = getenv("PH_CLOCK_FROM");
  const long wrong = atomic_fetch_add(&calls, 1) + 1 - (from ? atol(from) : 1);
  if (how == NULL || wrong < 0) return (int)syscall(SYS_clock_gettime, clock, now);
  static const char* const ways[] = {"back", "ahead", "frozen", "fails"};
  if (strcmp(how, "leaps") == 0) how = ways[chance((uint64_t)wrong) % 4];
  if (strcmp(how, "fails") == 0) {
    errno = EINVAL;
    return -1;
  }
  const int status = (int)syscall(SYS_clock_gettime, clock, now);
  /* A clock is at most two centuries ahead, because std::chrono counts nanoseconds in 64 bits,
   * which cover only 292 years. */
  if (strcmp(how, "back") == 0)
    now->tv_sec -= HOUR * (wrong + 1);
  else if (strcmp(how, "ahead") == 0)
    now->tv_sec += CENTURY * (wrong < 1 ? 1 : 2);
  else
    now->tv_sec = 1000, now->tv_nsec = 0;
  return status;
}
