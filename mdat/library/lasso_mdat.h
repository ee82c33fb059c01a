/* The registration and the search of the flight component for programs in C, and in all languages that call C (python/lasso_mdat): what
 * mdat replay computes of a scan, bit by bit. Built by make python as liblasso_mdat.so; needs no other library of this project.
 *
 * Poses are T_sensor_target: quaternion x, y, z, w (Hamilton), then the target's origin in metres, both in the sensor's frame (z boresight,
 * x right, y down). Covariances are of (rotation about the target's origin, translation), rad and m, in the sensor's axes, by rows
 * (docs/conventions.md). One thread uses a target at a time; several targets are independent.
 *
 * Functions that return int give 0, or LASSO_BAD_INPUT, and then a sentence in `why`: at most `room` bytes, its end included. */
#ifndef LASSO_MDAT_H
#define LASSO_MDAT_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All else of the library is hidden. */
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

#define LASSO_INTERFACE 1 /* counts up when something here changes */
#define LASSO_BAD_INPUT 2
#define LASSO_MOST_CANDIDATES 6

typedef struct lasso_target lasso_target;

/* One ray, as the sensor gave it. */
typedef struct {
  float direction[3]; /* unit vector */
  float range_m;      /* of a return, else 0 */
  int64_t t_us;       /* ascending from ray to ray */
  float sigma_factor; /* 1, or more where its noise is larger than the sensor's */
  int32_t state;      /* 0 a return, 1 nothing came back, 2 no statement */
} lasso_ray;

/* One scan. `misses_known` 0: rays that are not listed say nothing. */
typedef struct {
  const lasso_ray* rays;
  size_t count;
  int32_t misses_known;
} lasso_scan;

typedef struct {
  double pose[7];
  double covariance[36];
  int64_t t_us;   /* the middle between first and last ray, at which the pose is stated */
  int32_t valid;  /* 1: reason 0 */
  int32_t reason; /* lasso_reason tells it in words */
  int32_t iterations, rays, returns, inliers;
  double rms_m, normalized_residual, inlier_share, agreement;
} lasso_registration;

typedef struct {
  double pose[7];
  double disagreement, score; /* smaller is better */
} lasso_candidate;

typedef struct {
  double pose[7]; /* the best candidate's, whatever the outcome */
  double covariance[36];
  int64_t t_us;
  int32_t outcome; /* 0 none, 1 accepted, 2 ambiguous, 3 rejected: lasso_outcome */
  int32_t reason;  /* lasso_search_reason */
  double disagreement, ratio;
  int32_t candidates;
  lasso_candidate candidate[LASSO_MOST_CANDIDATES];
} lasso_search_result;

/* LASSO_INTERFACE of the library, for who has loaded it; and how many rays of a scan it takes at most. */
int lasso_interface(void);
size_t lasso_most_rays(void);

/* A target from the bytes of a flight image (mdat mission compile). Null, and why, where they are none. */
lasso_target* lasso_open(const uint8_t* image, size_t bytes, char* why, size_t room);
void lasso_close(lasso_target* target);

/* Points as rays. `points_m`: x, y, z of a return, of a miss its unit direction; rows of zeros or NaN are no rays. `times_s` ascending, or
 * null: all at once. `hits`: 1 a return, 0 a miss; null: all are returns. `rays` has room for lasso_most_rays(); of more points some are
 * taken that are spread over their directions. */
int lasso_rays_of_points(const double* points_m, const double* times_s, const uint8_t* hits, size_t points, lasso_ray* rays, size_t* count,
                         char* why, size_t room);

/* Registers one scan from a pose. `wide` 1: the prior is rough (20 deg, a quarter of the target's size). With the mission's start.check the
 * scan is searched as well. */
int lasso_register(lasso_target* target, const lasso_scan* scan, const double prior[7], int wide, lasso_registration* result, char* why,
                   size_t room);

/* Finds the target in one scan without a pose to start from. */
int lasso_search(lasso_target* target, const lasso_scan* scan, lasso_search_result* result, char* why, size_t room);

/* Words for numbers. */
const char* lasso_reason(int32_t reason);
const char* lasso_outcome(int32_t outcome);
const char* lasso_search_reason(int32_t reason);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#ifdef __cplusplus
}
#endif

#endif
