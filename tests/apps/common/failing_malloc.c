/* SPDX-License-Identifier: MIT */
/* A library to be preloaded into a program: malloc and its relatives fail at the n-th call after
 * main has begun (PH_FAIL_AT=n), and with PH_FAIL_FROM=n at all calls from the n-th on. The
 * requested sizes are written to PH_CALLS_FILE, one per line. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* glibc's own names of the functions; looking the functions up with dlsym would allocate memory. */
extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);

#define MOST_CALLS (1L << 20)

static atomic_long calls;
static size_t sizes[MOST_CALLS];
static long fail_at, fail_from;
static int armed;

static int fails(size_t size) {
  if (!armed) return 0;
  const long call = atomic_fetch_add(&calls, 1) + 1;
  if (call <= MOST_CALLS) sizes[call - 1] = size;
  if (call != fail_at && (fail_from == 0 || call < fail_from)) return 0;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) { return fails(size) ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) {
  return fails(count * size) ? NULL : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) { return fails(size) ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) {
  return fails(size) ? NULL : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  if (fails(size)) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}

static void write_calls(void) {
  const char* path = getenv("PH_CALLS_FILE");
  if (!path) return;
  armed = 0;
  FILE* file = fopen(path, "w");
  const long count = atomic_load(&calls);
  for (long i = 0; file && i < count && count <= MOST_CALLS; ++i) fprintf(file, "%zu\n", sizes[i]);
  if (file) fclose(file);
}

static int (*real_main)(int, char**, char**);

static int counted_main(int argc, char** argv, char** environment) {
  const char* at = getenv("PH_FAIL_AT");
  const char* from = getenv("PH_FAIL_FROM");
  fail_at = at ? atol(at) : 0;
  fail_from = from ? atol(from) : 0;
  atexit(write_calls);
  armed = 1;
  const int code = real_main(argc, argv, environment);
  armed = 0;
  return code;
}

/* Wraps main, because calls before main are not made by the program. */
int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(void),
                      void (*fini)(void), void (*loader_fini)(void), void* stack_end) {
  int (*start)(int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void),
               void (*)(void), void*);
  *(void**)&start = dlsym(RTLD_NEXT, "__libc_start_main");
  real_main = main;
  return start(counted_main, argc, argv, init, fini, loader_fini, stack_end);
}
