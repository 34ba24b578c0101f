/* SPDX-License-Identifier: MIT */
/* The C interface's part of front_door.py: reads doubles in the machine's byte order, calls
 * ph_rips_points or ph_rips_distances with one thread, and prints the same lines as
 * front_door.cpp. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ph/ph.h"

/* @return the numbers of a file that must hold `count` of them; NULL if it does not. */
static double* numbers_of(const char* path, size_t count) {
  FILE* file = fopen(path, "rb");
  double* numbers = malloc(count * sizeof(double));
  if (file == NULL || numbers == NULL || fread(numbers, sizeof(double), count, file) != count) {
    free(numbers);
    numbers = NULL;
  }
  if (file != NULL) fclose(file);
  return numbers;
}

static void print_summary(const ph_barcode* bars, int max_dim) {
  const ph_bar* bar = ph_barcode_bars(bars);
  for (int dim = 0; dim <= max_dim; ++dim) {
    size_t count = 0;
    double lengths = 0;
    for (size_t i = 0; i < ph_barcode_size(bars); ++i) {
      if (bar[i].dim != dim) continue;
      ++count;
      if (isfinite(bar[i].death)) lengths += bar[i].death - bar[i].birth;
    }
    printf("%d %zu %.17g\n", dim, count, lengths);
  }
}

int main(int argc, char** argv) {
  if (argc != 6) {
    fprintf(stderr,
            "usage: %s points|distances ROWS COLUMNS MAX_DIM FILE\n"
            "points: FILE has ROWS * COLUMNS doubles; distances: the strict lower triangle\n",
            argv[0]);
    return 64;
  }
  const int is_points = strcmp(argv[1], "points") == 0;
  const int64_t rows = atoll(argv[2]), columns = atoll(argv[3]);
  double* data = numbers_of(argv[5], (size_t)(is_points ? rows * columns : rows * (rows - 1) / 2));
  if (data == NULL) {
    fprintf(stderr, "%s: not so many numbers\n", argv[5]);
    return 65;
  }
  ph_options options;
  ph_options_init(&options);
  options.max_dim = atoi(argv[4]);
  options.threads = 1;
  ph_barcode* bars;
  const ph_status status = is_points
                               ? ph_rips_points(data, rows, columns, columns, 1, &options, &bars)
                               : ph_rips_distances(data, rows, &options, &bars);
  free(data);
  if (status != PH_OK) {
    fprintf(stderr, "%s\n", ph_last_error());
    return 70;
  }
  print_summary(bars, options.max_dim);
  ph_barcode_free(bars);
  return 0;
}
