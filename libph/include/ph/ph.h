/* SPDX-License-Identifier: MIT */
#ifndef PH_PH_H
#define PH_PH_H
/* Persistent homology from C, and from all languages that call C: points, distances or an image
 * in, a barcode out. Link ph::c (libph_c.so).
 *
 * - A function that can fail returns a ph_status; after a failure, ph_last_error() returns this
 *   thread's message.
 * - The caller frees the handles that a function returns. No handle keeps its input.
 * - No C++ exception leaves the library. Several threads may call its functions at once.
 * - The layout of this header is version PH_ABI_VERSION. Structs may grow at their end: the member
 *   `size`, which ph_options_init fills in, tells the library which members the caller knows. */
#include <stddef.h>
#include <stdint.h>

#if defined(PH_C_BUILD) && defined(__GNUC__)
#define PH_API __attribute__((visibility("default")))
#else
#define PH_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define PH_ABI_VERSION 1
/** The version of the layout that the library uses. Refuse any library whose version is not
 * PH_ABI_VERSION. */
PH_API int ph_abi_version(void);
/** The version as text, such as "0.1.0". */
PH_API const char* ph_version(void);

typedef enum ph_status {
  PH_OK = 0,
  PH_USAGE = 1,     /**< an argument or option is invalid */
  PH_BAD_DATA = 2,  /**< the input is malformed or breaks a precondition */
  PH_RESOURCE = 3,  /**< a limit on memory or on another resource would be exceeded */
  PH_CANCELLED = 4, /**< ph_options::cancel requested a stop */
  PH_INTERNAL = 5   /**< a bug in libph */
} ph_status;

/** One line about this thread's last call that did not return PH_OK; never NULL. */
PH_API const char* ph_last_error(void);

/** How voxels become cubes. PH_VERTICES: voxels are vertices, and a cube enters with its last
 * vertex. PH_CELLS: voxels are top cubes, and a face enters with its first cube. */
typedef enum ph_construction { PH_VERTICES = 0, PH_CELLS = 1 } ph_construction;
typedef enum ph_distance {
  PH_EUCLIDEAN = 0,
  PH_MANHATTAN = 1,
  PH_CHEBYSHEV = 2,
  PH_MINKOWSKI = 3, /**< exponent: ph_options::minkowski_p */
  PH_COSINE = 4,
  PH_HAMMING = 5
} ph_distance;
#ifdef __cplusplus /* Any other number may be passed as well, and is refused. */
typedef enum ph_number : unsigned int {
#else
typedef enum ph_number {
#endif
  PH_UINT8 = 0,
  PH_UINT16 = 1,
  PH_INT16 = 2,
  PH_FLOAT32 = 3,
  PH_FLOAT64 = 4
} ph_number;

/** Called about every 20 ms, on the calling thread. @return a number other than 0 to stop. */
typedef int (*ph_cancel)(void* user);

typedef struct ph_options {
  size_t size;            /**< size of this struct; see ph_options_init */
  int32_t max_dim;        /**< highest dimension; -1: 1 for points, all for images */
  int32_t min_dim;        /**< lowest dimension */
  int64_t field;          /**< characteristic of the coefficients: a prime below 2^31 */
  double threshold;       /**< cells of larger values never enter; NaN: the default */
  double min_persistence; /**< bars with death - birth <= this are left out; < 0: keeps all */
  int32_t cells;          /**< not 0: bars have the cells of their birth and death */
  int32_t threads;        /**< 0: one per core */
  uint64_t memory_limit;  /**< bytes that the computation may take; 0: no limit */
  ph_cancel cancel;       /**< may be NULL */
  void* cancel_user;      /**< argument of `cancel` */
  /* points only */
  int32_t distance;   /**< a ph_distance */
  double minkowski_p; /**< >= 1 */
  /* images only */
  int32_t construction;    /**< a ph_construction */
  int32_t superlevel;      /**< not 0: superlevel sets of f, as sublevel sets of -f */
  int32_t masked;          /**< not 0: NaN marks an absent voxel; otherwise NaN is an error */
  const uint8_t* periodic; /**< one per axis, not 0: the axis closes up; NULL: none does */
} ph_options;

/** Fills in the default options. */
#define ph_options_init(options) ph_options_init_sized((options), sizeof(ph_options))
PH_API void ph_options_init_sized(ph_options* options, size_t size);

/** The half-open interval [birth, death) of a class of H_dim; death is +infinity if the class never
 * dies. */
typedef struct ph_bar {
  int32_t dim;
  double birth, death;
} ph_bar;

typedef struct ph_barcode ph_barcode;

/** The Vietoris-Rips filtration of points: point i, coordinate k is data[i * row_stride + k *
 * column_stride]. If rows follow each other without gaps, the strides are `columns` and 1. Equal
 * points become one vertex, named by the first of them, unless bars of length 0 are requested
 * (min_persistence < 0).
 * @param options NULL: the defaults. @param out set on PH_OK only. */
PH_API ph_status ph_rips_points(const double* data, int64_t rows, int64_t columns,
                                int64_t row_stride, int64_t column_stride,
                                const ph_options* options, ph_barcode** out);

/** The Vietoris-Rips filtration of distances, given as the strict lower triangle row by row,
 * d(1,0), d(2,0), d(2,1), …; size * (size - 1) / 2 numbers, each >= 0 or +infinity. */
PH_API ph_status ph_rips_distances(const double* lower, int64_t size, const ph_options* options,
                                   ph_barcode** out);

/** The cubical filtration of an image: voxel (i, j, …) is data[i * strides[0] + j * strides[1] +
 * …]. It is read in place if it is aligned and in C order without gaps; otherwise it is copied.
 * @param data numbers of type `type`. @param extents `axes` lengths, 1 to 8 of them.
 * @param strides NULL: C order, the last axis the fastest. */
PH_API ph_status ph_cubical_image(const void* data, ph_number type, int32_t axes,
                                  const int64_t* extents, const int64_t* strides,
                                  const ph_options* options, ph_barcode** out);

/** ph_rips_points for many clouds, several at a time: for many small inputs this is faster than one
 * call per cloud. ph_options::threads and memory_limit apply to all inputs together.
 * @param clouds clouds[i] is the start of rows[i] points of `columns` numbers each, row after row.
 * @param out an array of `count` handles, set on PH_OK only. If one input causes an error,
 * ph_last_error() gives its number, counted from 0. */
PH_API ph_status ph_rips_points_batch(const double* const* clouds, const int64_t* rows,
                                      int64_t columns, size_t count, const ph_options* options,
                                      ph_barcode** out);

/** ph_cubical_image for many images of the same extents, each in C order. Everything else is as for
 * ph_rips_points_batch. */
PH_API ph_status ph_cubical_image_batch(const void* const* images, ph_number type, int32_t axes,
                                        const int64_t* extents, size_t count,
                                        const ph_options* options, ph_barcode** out);

/** The number of bars. Bars are ordered by dimension, birth, death and birth cell. */
PH_API size_t ph_barcode_size(const ph_barcode* bars);
/** An array of all bars, which lives as long as the handle; NULL if there are no bars. */
PH_API const ph_bar* ph_barcode_bars(const ph_barcode* bars);
/** The cell that gave birth to bar i, or the cell that killed it. For points, the numbers are the
 * vertices of the cell, ascending. For images, they are its doubled grid coordinates; with
 * PH_VERTICES, 2k is voxel k, and 2k + 1 spans voxels k and k + 1.
 * @param numbers set to an array that lives as long as the handle. @return the number of numbers; 0
 * for the death of a bar that never dies, without ph_options::cells, or beyond the last bar. */
PH_API size_t ph_barcode_birth_cell(const ph_barcode* bars, size_t i, const int64_t** numbers);
PH_API size_t ph_barcode_death_cell(const ph_barcode* bars, size_t i, const int64_t** numbers);
/** Frees a barcode; the handle may be NULL. */
PH_API void ph_barcode_free(ph_barcode* bars);

#ifdef __cplusplus
}
#endif
#endif
