/* SPDX-License-Identifier: MIT */
/* Uses the C interface to find the loop of points on a circle and the dark spots of an image. */
#include <math.h>
#include <stdio.h>

#include "ph/ph.h"

static int never(void* user) {
  (void)user;
  return 0; /* any other value stops the computation */
}

int main(void) {
  double points[40][2];
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 40;
    points[i][0] = cos(angle);
    points[i][1] = sin(angle);
  }
  if (ph_abi_version() != PH_ABI_VERSION) return 1;

  ph_options options;
  ph_options_init(&options);
  options.memory_limit = 100 << 20;
  options.cancel = never;
  ph_barcode* bars;
  if (ph_rips_points(&points[0][0], 40, 2, 2, 1, &options, &bars) != PH_OK) {
    fprintf(stderr, "%s\n", ph_last_error());
    return 1;
  }
  const ph_bar* bar = ph_barcode_bars(bars);
  for (size_t i = 0; i < ph_barcode_size(bars); ++i) {
    if (bar[i].dim != 1) continue;
    const int64_t* ends;
    ph_barcode_birth_cell(bars, i, &ends);
    printf("a loop from %.2f to %.2f, closed by points %d and %d\n", bar[i].birth, bar[i].death,
           (int)ends[0], (int)ends[1]);
  }
  ph_barcode_free(bars);

  const uint8_t image[3][4] = {{1, 9, 9, 2}, {9, 9, 9, 9}, {3, 9, 9, 9}};
  const int64_t extents[] = {3, 4};
  ph_options_init(&options);
  options.max_dim = 0;
  if (ph_cubical_image(image, PH_UINT8, 2, extents, NULL, &options, &bars) != PH_OK) {
    fprintf(stderr, "%s\n", ph_last_error());
    return 1;
  }
  printf("%d dark spots\n", (int)ph_barcode_size(bars));
  ph_barcode_free(bars);
  return 0;
}
